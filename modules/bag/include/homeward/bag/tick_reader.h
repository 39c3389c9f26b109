// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/record/tick.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** Reads what TickRecorder wrote. */
class TickReader
{
public:
  /**
   * @param parts bags of one recording in their order, see bagParts()
   * @throw StoreError when they cannot be read or are no recording of ours
   */
  explicit TickReader(std::vector<std::filesystem::path> parts);
  ~TickReader();

  /** JSON, as TickRecorder was given it. */
  const std::string &setup() const;

  /** The next tick; nothing at the end. @throw StoreError when a bag cannot be read */
  std::optional<Tick> next();

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
