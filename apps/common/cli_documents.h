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

/** The manual page of a program and all its subcommands, as man(7) source. */
std::string manPage(const CLI::App &program, const std::string &version);

/** A script that completes a program's subcommands, options and files in bash. */
std::string bashCompletion(const CLI::App &program);

/**
 * What a program prints instead of running when its only argument is `--man` or `--completion`,
 * which packages are built with; nothing for any other arguments.
 */
std::optional<std::string> cliDocument(const CLI::App &program, const std::string &version,
                                       int argc, char **argv);

} // namespace homeward
