// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/servo/feature_home_vector.h>

#include "feature_support.h"

#include <homeward/core/angle.h>
#include <homeward/core/error.h>

#include <cmath>
#include <iostream>
#include <string>

namespace homeward
{

FeatureHomeVector::FeatureHomeVector()
{
  init();
}

void FeatureHomeVector::init()
{
  dim_s = 2;
  s.resize(dim_s);
  s[0] = 1.0;
}

void FeatureHomeVector::set(double rho, double beta)
{
  if (!(rho > 0.0) || !std::isfinite(rho) || !std::isfinite(beta)) {
    throw LogicError("home vector is rho " + std::to_string(rho) + ", beta " +
                     std::to_string(beta) + ", must be finite with rho > 0");
  }
  s[0] = rho;
  s[1] = beta;
}

vpMatrix FeatureHomeVector::interaction(unsigned int select)
{
  const double c = std::cos(beta());
  const double sine = std::sin(beta());
  vpMatrix L(2, 6);
  L[0][0] = -c;
  L[0][1] = -sine;
  L[1][0] = sine / rho();
  L[1][1] = -c / rho();
  L[1][5] = -1.0;
  return selectRows(L, select);
}

vpColVector FeatureHomeVector::error(const vpBasicFeature &wanted, unsigned int select)
{
  vpMatrix e(2, 1);
  e[0][0] = s[0] - wanted[0];
  e[1][0] = wrapAngle(s[1] - wanted[1]);
  return vpColVector(selectRows(e, select));
}

void FeatureHomeVector::display(const vpCameraParameters & /*cam*/, const vpImage<unsigned char> &I,
                                const vpColor &color, unsigned int thickness) const
{
  displayArrow(I, beta(), color, thickness);
}

void FeatureHomeVector::display(const vpCameraParameters & /*cam*/, const vpImage<vpRGBa> &I,
                                const vpColor &color, unsigned int thickness) const
{
  displayArrow(I, beta(), color, thickness);
}

void FeatureHomeVector::print(unsigned int select) const
{
  std::cout << "Home vector:";
  if ((select & selectRho()) != 0U) {
    std::cout << " rho=" << rho();
  }
  if ((select & selectBeta()) != 0U) {
    std::cout << " beta=" << degrees(beta()) << " deg";
  }
  std::cout << '\n';
}

FeatureHomeVector *FeatureHomeVector::duplicate() const
{
  return new FeatureHomeVector(*this);
}

} // namespace homeward
