// SPDX-License-Identifier: GPL-3.0-or-later
#include "sdf_paths.h"

#include <cstdlib>
#include <sstream>

namespace fs = std::filesystem;

namespace homeward
{

SdfPaths::SdfPaths(const fs::path &worldFile)
{
  const fs::path folder = fs::absolute(worldFile).parent_path();
  m_folders = {folder, folder / "models", folder.parent_path() / "models"};
  for (const char *variable : {"GAZEBO_MODEL_PATH", "SDF_PATH"}) {
    const char *value = std::getenv(variable); // NOLINT(concurrency-mt-unsafe)
    std::istringstream list(value == nullptr ? "" : value);
    for (std::string entry; std::getline(list, entry, ':');) {
      if (!entry.empty()) {
        m_folders.emplace_back(entry);
      }
    }
  }
}

std::optional<fs::path> SdfPaths::find(const std::string &uri, const fs::path &besideFile) const
{
  std::error_code ignored;
  const std::size_t scheme = uri.find("://");
  const fs::path path = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
  if (path.empty()) {
    return std::nullopt;
  }
  if (path.is_absolute()) {
    return fs::exists(path, ignored) ? std::optional(path) : std::nullopt;
  }
  std::vector<fs::path> candidates;
  if (!besideFile.empty()) {
    candidates.push_back(besideFile.parent_path() / path);
  }
  for (const fs::path &folder : m_folders) {
    candidates.push_back(folder / path);
  }
  for (const fs::path &candidate : candidates) {
    if (fs::exists(candidate, ignored)) {
      return fs::absolute(candidate).lexically_normal();
    }
  }
  return std::nullopt;
}

} // namespace homeward
