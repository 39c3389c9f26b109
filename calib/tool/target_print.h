// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/calib/target.h>

#include <string>

namespace homeward
{

/** How a target is printed. */
struct TargetPage
{
  enum class Format
  {
    Pdf,
    Svg
  };
  Format format = Format::Pdf;
  std::string paper; ///< a4, a3, a2, a1, a0 or letter; empty: as large as the target
};

/**
 * The target to scale, with a line that says what it is and a scale of 100 mm to check the printer.
 * @throw ConfigError when the target does not fit the paper, or there is no such paper
 */
std::string printTarget(const Target &target, const TargetPage &page);

/** One line: what the target is and how to tell the program. */
std::string describe(const Target &target);

} // namespace homeward
