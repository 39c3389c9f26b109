// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sdf_paths.h"

#include <sdf/sdf.hh>

#include <memory>
#include <string>
#include <vector>

namespace homeward
{

/** An SDF file as far as it could be read. */
struct SdfDocument
{
  std::unique_ptr<sdf::Root> root;   ///< has one world or one model
  std::vector<std::string> problems; ///< one line for each part left out
};

/**
 * Reads an SDF file. Models, includes and lights that libsdformat refuses are left out.
 * @throw ConfigError when the file is missing, is not XML, or has neither world nor model
 */
SdfDocument readSdf(const std::filesystem::path &file, const SdfPaths &paths);

} // namespace homeward
