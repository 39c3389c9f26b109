// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace homeward
{

/** A folder of its own for a test, gone with it. */
class Folder
{
public:
  Folder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "homewardXXXXXX").string();
    m_path = mkdtemp(name.data());
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;

  std::string operator/(const std::string &name) const { return (m_path / name).string(); }

private:
  std::filesystem::path m_path;
};

} // namespace homeward
