// SPDX-License-Identifier: GPL-3.0-or-later
// Tutorial 08: a visual feature of your own in ViSP's servo.
//
// s = (phi), the phase of the first harmonic of the panorama's brightness round the horizon; a turn
// of the robot to the left by D turns it by -D, whatever the room. s* = phi of a stored panorama:
// the robot turns back to the heading it had there. Controlled freedom: wz alone.
#include "../support/laboratory.h"
#include "../support/plot.h"

#include <homeward/camera/rim.h>
#include <homeward/camera/unwarper.h>
#include <homeward/sim/simulator.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <visp3/visual_features/vpBasicFeature.h>
#include <visp3/vs/vpServo.h>

#include <complex>
#include <cstdio>
#include <iostream>

using namespace homeward;

/** phi = arg(sum over pixels of I exp(i azimuth)), radians. */
class FeaturePhase : public vpBasicFeature
{
public:
  FeaturePhase() { init(); }

  void init() override
  {
    dim_s = 1;
    s.resize(dim_s);
  }

  /** Measures it in a gray panorama. */
  void buildFrom(const Panorama &panorama)
  {
    cv::Mat1d column; // mean brightness of each
    cv::reduce(panorama.image, column, 0, cv::REDUCE_AVG, CV_64F);
    std::complex<double> sum;
    for (int u = 0; u < column.cols; ++u) {
      sum += std::polar(column(u), panorama.geometry.azimuth(u));
    }
    s[0] = std::arg(sum);
  }

  /** ds/dt = L (vx, vy, vz, wx, wy, wz) of the mirror. Near the place, moving changes phi little.
   */
  vpMatrix interaction(unsigned int /*select*/ = FEATURE_ALL) override
  {
    vpMatrix L(1, 6);
    L[0][5] = -1.0;
    return L;
  }

  /** s - s*, the short way round: a difference of angles. */
  vpColVector error(const vpBasicFeature &wanted, unsigned int /*select*/ = FEATURE_ALL) override
  {
    return vpColVector(1, wrapAngle(s[0] - wanted[0]));
  }

  FeaturePhase *duplicate() const override { return new FeaturePhase(*this); }
  void print(unsigned int /*select*/ = FEATURE_ALL) const override { std::cout << s[0] << '\n'; }
  void display(const vpCameraParameters & /*cam*/, const vpImage<unsigned char> & /*I*/,
               const vpColor & /*color*/ = vpColor::green,
               unsigned int /*thickness*/ = 1) const override
  {}
  void display(const vpCameraParameters & /*cam*/, const vpImage<vpRGBa> & /*I*/,
               const vpColor & /*color*/ = vpColor::green,
               unsigned int /*thickness*/ = 1) const override
  {}
};

int main()
{
  const Laboratory laboratory = loadLaboratory();
  SimulatorOptions options;
  options.start = Pose2{0.0, 0.0, 0.0};
  Simulator pioneer(laboratory.scene, laboratory.robot, laboratory.camera, options);
  const std::optional<Eigen::Vector2d> shift =
      rimShift(pioneer.camera().grab()->image, laboratory.camera);
  const Unwarper unwarper(shift ? followRim(laboratory.camera, {*shift}) : laboratory.camera,
                          PanoramaGeometry{});
  const auto look = [&] {
    cv::Mat gray;
    cv::cvtColor(pioneer.camera().grab()->image, gray, cv::COLOR_BGR2GRAY);
    return unwarper.unwarp(gray);
  };

  FeaturePhase now;
  FeaturePhase wanted;
  wanted.buildFrom(look());
  pioneer.kidnap({0.0, 0.0, radians(120.0)}); // somebody turns the robot

  vpServo task;
  task.setServo(vpServo::EYEINHAND_CAMERA);
  task.setInteractionMatrixType(vpServo::CURRENT);
  task.setLambda(0.8);
  task.addFeature(now, wanted);

  constexpr double kPeriod = 0.2; // s
  std::vector<double> degreesOff;
  for (int step = 0; step < 40; ++step) {
    now.buildFrom(look());
    const vpColVector v = task.computeControlLaw(); // six velocities, of which L asks for wz alone
    degreesOff.push_back(std::abs(degrees(pioneer.truth().pose.heading)));
    pioneer.base().drive({0.0, v[5]});
    pioneer.clock().sleepUntil(pioneer.clock().now() + fromSeconds(kPeriod));
  }
  cv::imwrite("08-own-feature.png", plot(degreesOff, kPeriod));

  std::printf("turned away by %.0f degrees\n", degreesOff.front());
  std::printf("after 8 s less than 3 degrees off: %s\n", degreesOff.back() < 3.0 ? "yes" : "no");
}
