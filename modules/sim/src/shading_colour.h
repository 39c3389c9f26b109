// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace homeward
{

/** sRGB-coded value in [0, 1] to linear. IEC 61966-2-1. */
inline float toLinear(float coded)
{
  const float c = std::clamp(coded, 0.0F, 1.0F);
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

/** sRGB-coded colour to linear, channel by channel. */
inline Eigen::Vector3f toLinear(const Eigen::Vector3f &coded)
{
  return {toLinear(coded.x()), toLinear(coded.y()), toLinear(coded.z())};
}

/** Linear value in [0, 1] to sRGB-coded. IEC 61966-2-1. */
inline float toCoded(float linear)
{
  const float c = std::clamp(linear, 0.0F, 1.0F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
}

} // namespace homeward
