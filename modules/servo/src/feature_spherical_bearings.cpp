// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/feature_spherical_bearings.h>

#include "feature_support.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <visp3/core/vpDisplay.h>
#include <visp3/core/vpImagePoint.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#ifdef ENABLE_VISP_NAMESPACE
using namespace VISP_NAMESPACE_NAME;
#endif

namespace homeward
{

namespace
{

constexpr double kUnitTolerance = 1e-6;

void checkBearing(const SphericalBearing &bearing)
{
  const double length = bearing.direction.norm();
  if (!(std::abs(length - 1.0) <= kUnitTolerance)) {
    throw LogicError("bearing has a direction of length " + std::to_string(length) + ", must be 1");
  }
  if (!(bearing.range > 0.0) || !std::isfinite(bearing.range)) {
    throw LogicError("bearing has range " + std::to_string(bearing.range) +
                     ", must be finite and positive");
  }
}

template <class Pixel>
void displayFromAbove(const vpImage<Pixel> &I, const std::vector<SphericalBearing> &bearings,
                      const vpColor &color, unsigned int thickness)
{
  const double radius = std::min(I.getHeight(), I.getWidth()) / 2.0;
  for (const SphericalBearing &bearing : bearings) {
    const vpImagePoint point(I.getHeight() / 2.0 - radius * bearing.direction.x(),
                             I.getWidth() / 2.0 - radius * bearing.direction.y());
    vpDisplay::displayCross(I, point, 6 + 2 * thickness, color, thickness);
  }
}

} // namespace

FeatureSphericalBearings::FeatureSphericalBearings()
{
  init();
}

void FeatureSphericalBearings::init()
{
  m_bearings.clear();
  dim_s = 0;
  s.resize(0);
}

void FeatureSphericalBearings::set(const std::vector<SphericalBearing> &bearings)
{
  if (bearings.empty()) {
    throw LogicError("a feature of bearings needs at least one point, got 0");
  }
  std::for_each(bearings.begin(), bearings.end(), checkBearing);
  m_bearings = bearings;
  dim_s = static_cast<unsigned int>(3 * bearings.size());
  s.resize(dim_s);
  for (unsigned int row = 0; row < dim_s; ++row) {
    s[row] = bearings[row / 3].direction[row % 3];
  }
}

vpMatrix FeatureSphericalBearings::interaction(unsigned int /*select*/)
{
  vpMatrix L(dim_s, 6);
  for (unsigned int row = 0; row < dim_s; ++row) {
    const unsigned int axis = row % 3;
    const SphericalBearing &bearing = m_bearings[row / 3];
    const Eigen::Vector3d &direction = bearing.direction;
    for (unsigned int column = 0; column < 3; ++column) {
      const double identity = axis == column ? 1.0 : 0.0;
      L[row][column] = (direction[axis] * direction[column] - identity) / bearing.range;
    }
    // Row `axis` of [s]x.
    const unsigned int next = (axis + 1) % 3;
    const unsigned int last = (axis + 2) % 3;
    L[row][3 + next] = -direction[last];
    L[row][3 + last] = direction[next];
  }
  return L;
}

vpColVector FeatureSphericalBearings::error(const vpBasicFeature &wanted, unsigned int /*select*/)
{
  return difference(s, wanted);
}

void FeatureSphericalBearings::display(const vpCameraParameters & /*cam*/,
                                       const vpImage<unsigned char> &I, const vpColor &color,
                                       unsigned int thickness) const
{
  displayFromAbove(I, m_bearings, color, thickness);
}

void FeatureSphericalBearings::display(const vpCameraParameters & /*cam*/, const vpImage<vpRGBa> &I,
                                       const vpColor &color, unsigned int thickness) const
{
  displayFromAbove(I, m_bearings, color, thickness);
}

void FeatureSphericalBearings::print(unsigned int /*select*/) const
{
  std::cout << "Bearings:";
  for (const SphericalBearing &bearing : m_bearings) {
    const Eigen::Vector3d &direction = bearing.direction;
    std::cout << " (" << degrees(std::atan2(direction.y(), direction.x())) << ", "
              << degrees(std::asin(std::clamp(direction.z(), -1.0, 1.0))) << ") deg";
  }
  std::cout << '\n';
}

FeatureSphericalBearings *FeatureSphericalBearings::duplicate() const
{
  return new FeatureSphericalBearings(*this);
}

} // namespace homeward
