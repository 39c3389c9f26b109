// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/feature_heading.h>

#include "feature_support.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <cmath>
#include <iostream>
#include <string>

namespace homeward
{

FeatureHeading::FeatureHeading()
{
  init();
}

void FeatureHeading::init()
{
  dim_s = 1;
  s.resize(dim_s);
}

void FeatureHeading::set(double psi)
{
  if (!std::isfinite(psi)) {
    throw LogicError("heading is " + std::to_string(psi) + ", must be finite");
  }
  s[0] = psi;
}

vpMatrix FeatureHeading::interaction(unsigned int select)
{
  vpMatrix L(1, 6);
  L[0][5] = 1.0;
  return selectRows(L, select);
}

vpColVector FeatureHeading::error(const vpBasicFeature &wanted, unsigned int select)
{
  vpMatrix e(1, 1);
  e[0][0] = wrapAngle(s[0] - wanted[0]);
  return vpColVector(selectRows(e, select));
}

void FeatureHeading::display(const vpCameraParameters & /*cam*/, const vpImage<unsigned char> &I,
                             const vpColor &color, unsigned int thickness) const
{
  displayArrow(I, -psi(), color, thickness);
}

void FeatureHeading::display(const vpCameraParameters & /*cam*/, const vpImage<vpRGBa> &I,
                             const vpColor &color, unsigned int thickness) const
{
  displayArrow(I, -psi(), color, thickness);
}

void FeatureHeading::print(unsigned int select) const
{
  if ((select & FEATURE_LINE[0]) != 0U) {
    std::cout << "Heading: psi=" << degrees(psi()) << " deg\n";
  }
}

FeatureHeading *FeatureHeading::duplicate() const
{
  return new FeatureHeading(*this);
}

} // namespace homeward
