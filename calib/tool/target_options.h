// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cli_app.h"

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

  /** @throw CLI::ValidationError for what cannot be printed */
  Target target() const;
};

/** Adds --target, --columns, --rows, --pitch and --marker. */
void addTargetOptions(CLI::App &command, TargetOptions &options);

} // namespace homeward
