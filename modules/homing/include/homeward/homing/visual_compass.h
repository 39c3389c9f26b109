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

/** What is compared. */
struct CompassOptions
{
  /** Bands of rows that are averaged first, which is faster; 0: every row by itself. */
  int bands = 16;
  /** Edges of the log intensity, of one strength in every band: light and exposure do not matter.
   */
  bool edges = true;
};

/** The compass as published: brightness, every row by itself. */
inline constexpr CompassOptions kZeilCompass{0, false};

/**
 * The turn that makes two panoramas most alike: the shift k that minimises
 *
 *     ssd(k) = sum over pixels of (C(i + k, j) - S(i, j))^2
 *
 * read as +2 pi k / width, since columns grow clockwise; all shifts at once by FFT, refined by a
 * parabola. By default edges are compared, which holds in any light; it holds near the snapshot's
 * place only. \cite Zeil2003
 * @return nothing when either picture is (nearly) the same all round
 * @throw LogicError when the geometries differ, a picture does not fit its geometry, or there are
 * more bands than rows
 */
std::optional<CompassReading> visualCompass(const Panorama &current, const Panorama &snapshot,
                                            const CompassOptions &options = {});

} // namespace homeward
