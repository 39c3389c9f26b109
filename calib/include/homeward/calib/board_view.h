// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homeward
{

/** The points of a calibration target that one picture shows; partial boards are welcome. */
struct BoardView
{
  std::string name;                    ///< the picture's, for messages
  std::vector<int> ids;                ///< which point of the target, one a point
  std::vector<Eigen::Vector3d> board;  ///< metres, frame of the target, one a point
  std::vector<Eigen::Vector2d> pixels; ///< centre of the top-left pixel is (0, 0); one a point
};

/** What one camera saw. */
struct BoardViews
{
  int width = 0;                ///< pixels
  int height = 0;               ///< pixels
  std::vector<BoardView> views; ///< one a picture in which it was found
};

} // namespace homeward
