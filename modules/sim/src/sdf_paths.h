// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** Finds the files and folders that a world names. */
class SdfPaths
{
public:
  explicit SdfPaths(const std::filesystem::path &worldFile);

  /**
   * The file or folder that a URI means, if it exists.
   * @param uri `model://NAME/...`, `file://...`, or a plain path
   * @param besideFile the file that names it, may be empty
   */
  std::optional<std::filesystem::path> find(const std::string &uri,
                                            const std::filesystem::path &besideFile = {}) const;

private:
  std::vector<std::filesystem::path> m_folders; ///< in the order of the search
};

} // namespace homeward
