// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/true_optics.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <Eigen/Geometry>

#include <cmath>
#include <string>

namespace homeward
{

namespace
{

constexpr std::uint32_t kOpticsStream = 0x6f707469U;
constexpr double kLargestTilt = radians(0.5);
constexpr double kLargestShift = 3.0;        ///< pixels
constexpr double kLargestFocalError = 0.005; ///< share

/** (e^2 - 1) / (e^2 + 1): what the mirror makes of the focal length. */
double magnification(double eccentricity)
{
  const double square = eccentricity * eccentricity;
  return (square - 1.0) / (square + 1.0);
}

/** 2 e / (e^2 + 1): the unified model's xi. */
double mirrorParameter(double eccentricity)
{
  return 2.0 * eccentricity / (eccentricity * eccentricity + 1.0);
}

} // namespace

std::optional<Eigen::Vector3d> TrueOptics::ray(const Eigen::Vector2d &pixel) const
{
  const double xi = mirrorParameter(eccentricity);
  const Eigen::Vector2d m = (pixel - centre).cwiseQuotient(focal) / magnification(eccentricity);
  const double radius = m.norm();
  // R (cos t + xi) = sin t, solved for h = tan(t / 2).
  const double h = radius * (1.0 + xi) / (1.0 + std::sqrt(1.0 + radius * radius * (1.0 - xi * xi)));
  const double cosine = (1.0 - h * h) / (1.0 + h * h);
  const double sine = 2.0 * h / (1.0 + h * h);
  if (cosine <= -xi + 1e-6) {
    return std::nullopt;
  }
  const double turn = std::atan2(m.y(), m.x()) - mount.forward;
  const double azimuth = mount.leftIsClockwise ? turn : -turn;
  return pRa * Eigen::Vector3d(sine * std::cos(azimuth), sine * std::sin(azimuth), -cosine);
}

std::optional<Eigen::Vector2d> TrueOptics::project(const Eigen::Vector3d &pX) const
{
  const double xi = mirrorParameter(eccentricity);
  const Eigen::Vector3d aX = pRa.transpose() * pX.normalized();
  const double sine = std::hypot(aX.x(), aX.y());
  if (-aX.z() <= -xi + 1e-6) {
    return std::nullopt;
  }
  const double radius = magnification(eccentricity) * sine / (-aX.z() + xi);
  const double azimuth = std::atan2(aX.y(), aX.x());
  const double angle = mount.forward + (mount.leftIsClockwise ? azimuth : -azimuth);
  return centre + radius * focal.cwiseProduct(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
}

TrueOptics exactOptics(const MirrorCamera &nominal)
{
  const UnifiedCamera::Parameters &parameters = nominal.model.parameters();
  const double xi = parameters.xi;
  if (xi <= 0.0 || xi >= 1.0) {
    throw LogicError("xi is " + std::to_string(xi) +
                     "; a hyperbolic mirror needs one between 0 and 1");
  }
  TrueOptics optics;
  optics.width = nominal.model.width();
  optics.height = nominal.model.height();
  optics.eccentricity = (1.0 + std::sqrt(1.0 - xi * xi)) / xi;
  optics.focal = Eigen::Vector2d(parameters.fx, parameters.fy) / magnification(optics.eccentricity);
  optics.centre = {parameters.cx, parameters.cy};
  optics.innerRadius = nominal.ring.inner;
  optics.outerRadius = nominal.ring.outer;
  optics.mount = nominal.mount;
  return optics;
}

TrueOptics drawOptics(const MirrorCamera &nominal, std::uint64_t seed)
{
  TrueOptics optics = exactOptics(nominal);
  Random random(seed, kOpticsStream);
  const double tiltAxis = random.uniform(-kPi, kPi);
  const double tilt = random.uniform(0.0, kLargestTilt);
  optics.pRa = Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(tiltAxis), std::sin(tiltAxis), 0.0))
                   .toRotationMatrix();
  const double shiftDirection = random.uniform(-kPi, kPi);
  const double shift = random.uniform(0.0, kLargestShift);
  optics.centre += shift * Eigen::Vector2d(std::cos(shiftDirection), std::sin(shiftDirection));
  optics.focal *= 1.0 + random.uniform(-kLargestFocalError, kLargestFocalError);
  return optics;
}

} // namespace homeward
