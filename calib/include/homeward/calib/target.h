// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homeward
{

/** What is printed on the board. */
enum class TargetKind
{
  Chessboard, ///< cheapest; a part of 4 x 3 corners will do
  CircleGrid, ///< discs on a regular grid; a part of 4 x 3 discs will do
  AprilGrid,  ///< tags of the family 36h11, each known by itself; partial boards count
  Charuco     ///< a chessboard with markers of 5x5 bits in its white squares; partial boards count
};

/**
 * A flat calibration target. Its frame: origin in its first point, x to the right, y down, z into
 * the paper, metres.
 */
struct Target
{
  TargetKind kind = TargetKind::Chessboard; ///< what it shows
  int columns = 9;     ///< inner corners, discs, tags, or squares of a ChArUco board
  int rows = 6;        ///< likewise
  double pitch = 0.03; ///< from one corner, disc, tag or square to the next, metres
  double marker = 0.0; ///< side of a tag or marker, metres; 0: 0.75 of the pitch

  /** Side of a marker, metres; three quarters of the pitch where none is given. */
  double markerSide() const { return marker > 0.0 ? marker : 0.75 * pitch; }
};

/** @throw ConfigError where a target like that cannot be printed or told from its mirror image */
void checkTarget(const Target &target);

/** chessboard, circles, aprilgrid or charuco. */
std::string nameOf(TargetKind kind);

/** The inverse of nameOf(). @throw ConfigError naming what there is */
TargetKind targetKindOf(const std::string &name);

/**
 * Every point of the target, by its id: corners and discs row by row, a tag's corners as tag times
 * four and then clockwise from the top left.
 */
std::vector<Eigen::Vector3d> targetPoints(const Target &target);

/** Top left corner of every marker, by its id, metres in the target's frame. */
std::vector<Eigen::Vector2d> markerCorners(const Target &target);

/** An axis-parallel rectangle, metres from the art's top left corner. */
struct ArtRectangle
{
  double x = 0.0;      ///< left side, metres
  double y = 0.0;      ///< upper side, metres
  double width = 0.0;  ///< metres
  double height = 0.0; ///< metres
};

/** A disc, metres from the art's top left corner. */
struct ArtDisc
{
  double x = 0.0;      ///< of the middle, metres
  double y = 0.0;      ///< of the middle, metres
  double radius = 0.0; ///< metres
};

/** What is black on the white paper, a quiet margin included. */
struct TargetArt
{
  double width = 0.0;                   ///< metres
  double height = 0.0;                  ///< metres
  Eigen::Vector2d origin;               ///< the target's first point
  std::vector<ArtRectangle> rectangles; ///< black
  std::vector<ArtDisc> discs;           ///< black
};

/** @throw ConfigError as checkTarget() */
TargetArt drawTarget(const Target &target);

} // namespace homeward
