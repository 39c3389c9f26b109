// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>
#include <homeward/core/scan.h>

#include <optional>

namespace homeward
{

/**
 * How badly `after` fits `before` if the laser turned left by `shift` readings between them: then
 * reading i shows what reading i + shift showed. Mean difference, metres, each counted as 1 m at
 * most; infinite where too few readings are comparable.
 */
double scanMisfit(const Scan &before, const Scan &after, int shift);

/**
 * Tells by turns whether a laser runs the right way round. Turned left by d, a scan looks as the
 * one before did d farther to the left; to a laser that is mounted upside down it looks turned to
 * the right. Whoever drives by such a laser avoids the mirror images of things.
 */
class TurnWitness
{
public:
  /**
   * Takes a scan and where the robot was by odometry, frame o, when it was taken.
   * @return true when turns of the last scans fit the other way round twice as well, and by 10 cm
   * a reading, twice in a row; a room that looks the same to both sides never does
   */
  bool contradicts(const Scan &scan, const Pose2 &oMr);

private:
  struct View
  {
    Scan scan;
    Pose2 oMr;
  };

  std::optional<View> m_before;
  int m_contradictions = 0; ///< in a row
};

/** Whether a scan says enough to drive by: at least half of its readings are known. */
bool saysEnough(const Scan &scan);

} // namespace homeward
