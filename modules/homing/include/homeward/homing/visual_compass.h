// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>

#include <optional>

namespace homeward
{

/** How far the robot has turned since a snapshot was taken at (nearly) the same place. */
struct CompassReading
{
  double headingChange = 0.0; ///< heading(current) - heading(stored), rad, in [-pi, pi)
  double confidence = 0.0;    ///< 0 (could be anything) to 1
};

/** What is compared. The default is the compass as published. */
struct CompassOptions
{
  /** Bands of rows that are averaged first, which is faster; 0: every row by itself. */
  int bands = 0;
  /** Edges of the log intensity, of one strength in every band: light and exposure do not matter.
   */
  bool edges = false;
};

/** Fast, and sure of itself when the light changes. */
inline constexpr CompassOptions kEdgeCompass{16, true};

/**
 * The turn that makes two panoramas most alike: the shift k that minimises
 *
 *     ssd(k) = sum over pixels of (C(i + k, j) - S(i, j))^2
 *
 * read as +2 pi k / width, since columns grow clockwise; all shifts at once by FFT, refined by a
 * parabola. It holds near the snapshot's place; on brightness only in the same light. \cite
 * Zeil2003
 * @return nothing when either picture is (nearly) the same all round
 * @throw LogicError when the geometries differ, a picture does not fit its geometry, or there are
 * more bands than rows
 */
std::optional<CompassReading> visualCompass(const Panorama &current, const Panorama &snapshot,
                                            const CompassOptions &options = {});

} // namespace homeward
