// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace CLI // NOLINT(readability-identifier-naming)
{
class App;
}

namespace homeward
{

/**
 * What a program prints instead of running when its only argument is `--man` (its manual page, as
 * man(7) source) or `--completion` (a script for bash), which packages are built with; nothing for
 * any other arguments.
 */
std::optional<std::string> cliDocument(const CLI::App &program, const std::string &version,
                                       int argc, char **argv);

} // namespace homeward
