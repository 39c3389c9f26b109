// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/homing/combined_homing.h>

#include <homeward/core/error.h>

namespace homeward
{

namespace
{

bool isShare(double value)
{
  return value >= 0.0 && value <= 1.0;
}

} // namespace

CombinedHoming::CombinedHoming(const CombinedHomingOptions &options) : m_options(options)
{
  if (!isShare(options.sure) || !isShare(options.bearingSure)) {
    throw LogicError("sure and bearingSure must be between 0 and 1");
  }
}

std::optional<HomeVector> CombinedHoming::compute(const Panorama &current, const Panorama &snapshot)
{
  const std::optional<HomeVector> warped = m_warping.compute(current, snapshot);
  if (warped && warped->confidence >= m_options.sure) {
    return warped;
  }
  const std::optional<HomeVector> seen = m_bearing.compute(current, snapshot);
  return seen && seen->confidence >= m_options.bearingSure ? seen : warped;
}

} // namespace homeward
