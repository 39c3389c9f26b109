// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "command_line.h"

#include <homeward/calib/target.h>

#include <string>

namespace homeward
{

/** A target as the command line gives it: millimetres, because people measure boards so. */
struct TargetOptions
{
  std::string kind = "chessboard";
  int columns = 9;
  int rows = 6;
  double pitch = 30.0; ///< millimetres
  double marker = 0.0; ///< millimetres

  /** @throw ConfigError for what cannot be printed */
  Target target() const;
};

/** Adds --target, --columns, --rows, --pitch and --marker. */
void addTargetOptions(CliCommand command, TargetOptions &options);

} // namespace homeward
