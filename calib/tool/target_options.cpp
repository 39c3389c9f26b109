// SPDX-License-Identifier: GPL-3.0-or-later
#include "target_options.h"

#include <homeward/core/error.h>

#include <CLI/CLI.hpp>

namespace homeward
{

Target TargetOptions::target() const
{
  constexpr double kMetres = 0.001;
  try {
    const Target target{targetKindOf(kind), columns, rows, pitch * kMetres, marker * kMetres};
    checkTarget(target);
    return target;
  }
  catch (const ConfigError &error) {
    throw CLI::ValidationError("target", error.what());
  }
}

void addTargetOptions(CLI::App &command, TargetOptions &options)
{
  command.add_option("--target", options.kind, "What is printed on the board")
      ->check(CLI::IsMember({"chessboard", "circles", "aprilgrid", "charuco"}))
      ->capture_default_str();
  command
      .add_option("--columns", options.columns, "Inner corners, circles, tags or ChArUco squares")
      ->capture_default_str();
  command.add_option("--rows", options.rows, "Likewise, downwards")->capture_default_str();
  command.add_option("--pitch", options.pitch, "From one to the next, mm")->capture_default_str();
  command.add_option("--marker", options.marker, "Side of a tag or marker, mm (0.75 of the pitch)");
}

} // namespace homeward
