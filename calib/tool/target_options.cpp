// SPDX-License-Identifier: GPL-3.0-or-later
#include "target_options.h"

namespace homeward
{

Target TargetOptions::target() const
{
  constexpr double kMetres = 0.001;
  const Target target{targetKindOf(kind), columns, rows, pitch * kMetres, marker * kMetres};
  checkTarget(target);
  return target;
}

void addTargetOptions(CliCommand command, TargetOptions &options)
{
  command
      .option("--target", options.kind,
              "What is printed on the board; tags are 36h11, ChArUco's markers "
              "OpenCV's DICT_5X5_1000")
      .oneOf({"chessboard", "circles", "aprilgrid", "charuco"})
      .showDefault();
  command.option("--columns", options.columns, "Inner corners, circles, tags or ChArUco squares")
      .showDefault();
  command.option("--rows", options.rows, "Likewise, downwards").showDefault();
  command.option("--pitch", options.pitch, "From one to the next, mm").showDefault();
  command.option("--marker", options.marker, "Side of a tag or marker, mm (0.75 of the pitch)")
      .between(0.1, 10000.0);
}

} // namespace homeward
