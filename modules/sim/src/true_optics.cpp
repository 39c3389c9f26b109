// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/sim/true_optics.h>

#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/core/random.h>

#include <Eigen/Geometry>

#include <algorithm>
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

/** Cosine of the angle from the axis that no ray of a picture reaches. */
double lowestCosine(double xi)
{
  return -std::min(xi, 1.0 / xi) + 1e-6;
}

} // namespace

std::optional<Eigen::Vector3d> TrueOptics::ray(const Eigen::Vector2d &pixel) const
{
  const Eigen::Vector2d m = (pixel - centre).cwiseQuotient(focal);
  const double radius = m.norm();
  // R (cos t + xi) = sin t, solved for h = tan(t / 2).
  const double underRoot = 1.0 + radius * radius * (1.0 - xi * xi);
  if (underRoot < 0.0) {
    return std::nullopt;
  }
  const double h = radius * (1.0 + xi) / (1.0 + std::sqrt(underRoot));
  const double cosine = (1.0 - h * h) / (1.0 + h * h);
  const double sine = 2.0 * h / (1.0 + h * h);
  if (cosine <= lowestCosine(xi)) {
    return std::nullopt;
  }
  const double turn = std::atan2(m.y(), m.x()) - mount.forward;
  const double azimuth = mount.leftIsClockwise ? turn : -turn;
  return pRa * Eigen::Vector3d(sine * std::cos(azimuth), sine * std::sin(azimuth), -cosine);
}

std::optional<Eigen::Vector2d> TrueOptics::project(const Eigen::Vector3d &pX) const
{
  const Eigen::Vector3d aX = pRa.transpose() * pX.normalized();
  const double sine = std::hypot(aX.x(), aX.y());
  if (-aX.z() <= lowestCosine(xi)) {
    return std::nullopt;
  }
  const double radius = sine / (-aX.z() + xi);
  const double azimuth = std::atan2(aX.y(), aX.x());
  const double angle = mount.forward + (mount.leftIsClockwise ? azimuth : -azimuth);
  return centre + radius * focal.cwiseProduct(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
}

TrueOptics exactOptics(const MirrorCamera &nominal)
{
  const UnifiedCamera::Parameters &parameters = nominal.model.parameters();
  if (!(parameters.xi > 0.0)) {
    throw LogicError("xi is " + std::to_string(parameters.xi) +
                     "; a camera under a mirror has a positive one");
  }
  TrueOptics optics;
  optics.width = nominal.model.width();
  optics.height = nominal.model.height();
  optics.xi = parameters.xi;
  optics.focal = {parameters.fx, parameters.fy};
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
