// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/angle.h>
#include <homeward/core/error.h>
#include <homeward/drivers/velocity_rounder.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace homeward
{
namespace
{

/** The whole units within a limit; one that is meant to be whole is. */
int wholeWithin(double limit)
{
  constexpr double kRounding = 1e-6;
  return static_cast<int>(std::floor(limit + kRounding));
}

} // namespace

VelocityRounder::VelocityRounder(const Limits &limits)
    : m_speed{wholeWithin(1000.0 * limits.maxSpeed)}, m_turnRate{
                                                          wholeWithin(degrees(limits.maxTurnRate))}
{}

WholeVelocity VelocityRounder::next(const Twist2 &wanted)
{
  if (!std::isfinite(wanted.v) || !std::isfinite(wanted.w)) {
    throw LogicError("velocity (" + std::to_string(wanted.v) + " m/s, " + std::to_string(wanted.w) +
                     " rad/s) is not finite");
  }
  return {m_speed.next(1000.0 * wanted.v), m_turnRate.next(degrees(wanted.w))};
}

void VelocityRounder::forget()
{
  m_speed.carried = 0.0;
  m_turnRate.carried = 0.0;
}

int VelocityRounder::Axis::next(double units)
{
  if (units == 0.0) {
    carried = 0.0;
    return 0;
  }
  const double wanted = std::clamp<double>(units, -most, most) + carried;
  const int low = units < 0.0 ? -most : 0;
  const int high = units < 0.0 ? 0 : most;
  const int sent = std::clamp(static_cast<int>(std::lround(wanted)), low, high);
  carried = std::clamp(wanted - sent, -0.5, 0.5);
  return sent;
}

} // namespace homeward
