// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/angle.h>
#include <homeward/core/scan.h>

#include <cstddef>
#include <vector>

namespace homeward
{

/** A run of far readings: a way that may be worth exploring. */
struct OpenDirection
{
  double bearing = 0.0; ///< middle of the run, rad counter-clockwise from the scan's forward axis
  double width = 0.0;   ///< from its first to its last reading, rad
  double range = 0.0;   ///< median of its readings, metres
};

/** What counts as open. */
struct OpenDirectionOptions
{
  double nearBound = 0.10; ///< metres; nearer readings are faults and dropped
  /**
   * Metres; farther readings are faults and dropped, but for those at the sensor's maximum, which
   * are far and open and count as this far. 0: nothing is dropped, and a reading of at least 0.95
   * of the sensor's maximum is far and open.
   */
  double farBound = 0.0;
  double openShare = 0.6;           ///< of the largest kept range, from which a reading is open
  double bridgedGap = radians(2.0); ///< rad of dropped readings that do not end a run
  double footprintWidth = 0.49;     ///< metres the robot needs
  double stoppingRange = 2.0;       ///< metres from here, where the run must be that wide
  std::size_t count = 4;            ///< how many directions are kept, the widest first
  /** Metres from which a reading is open whatever the largest is, for large open places; 0: off. */
  double openRangeCap = 0.0;
  /** Rad; a wider run is split into equal parts no wider than this, each a direction; 0: off. */
  double widestSegment = 0.0;
};

/**
 * Directions worth exploring from one place, the widest first (equally wide: by bearing).
 *
 * A reading is open when it is at least openShare of the largest kept range. A run of open readings
 * is a segment; dropped and unknown readings are bridged up to bridgedGap and end it beyond. A
 * segment goes on across +-pi only where the scan closes there. The direction of a segment is
 * start + length / 2. \cite Thesis, eq. (4.1)
 *
 * @param robotScan360 centred on the robot and along its forward axis, up to a full turn
 * @throw LogicError for options out of bounds, a scan of more than a full turn or without a step
 */
std::vector<OpenDirection> findOpenDirections(const Scan &robotScan360,
                                              const OpenDirectionOptions &options);

} // namespace homeward
