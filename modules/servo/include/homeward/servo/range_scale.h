// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <deque>

namespace homeward
{

/**
 * How many metres a distance proxy stands for, found by driving: seen from places whose odometry is
 * known, bearings of home cross where it lies, and proxies grow with the distance from there.
 * Linear least squares over the place of home and the scale; proxies alone leave the scale as it
 * was guessed.
 */
class RangeScale
{
public:
  /** @param guess metres that a proxy of 1 stands for as long as nothing else is known */
  explicit RangeScale(double guess) : m_guess(guess), m_scale(guess) {}

  /**
   * One view of home.
   * @param oMirror where the mirror's focus was, odometry frame, metres
   * @param oBearing of home from there, odometry frame, radians
   * @param proxy distance proxy of home
   * @param weight of the view against others, e.g. its confidence
   */
  void add(const Eigen::Vector2d &oMirror, double oBearing, double proxy, double weight);

  /** Metres that a distance proxy of 1 stands for near home. */
  double metres() const { return m_scale; }

private:
  struct View
  {
    Eigen::Vector2d oMirror;
    double oBearing = 0.0;
    double proxy = 0.0;
    double weight = 0.0;
  };

  void solve();

  double m_guess;
  double m_scale;
  std::deque<View> m_views; ///< oldest first
};

} // namespace homeward
