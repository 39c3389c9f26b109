// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/record/tick.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace homeward
{

/** How a run is recorded. */
struct RecorderOptions
{
  std::uint64_t fileBytes = 1'000'000'000; ///< a bag that has so many is closed, the next begins
  std::size_t waitingBytes = 64'000'000;   ///< of pictures and readings that wait to be written
  bool mayWait = false; ///< keep() waits for room; else what does not fit is lost, and counted
};

/** What a recording came to. */
struct RecordingCounts
{
  std::size_t ticks = 0;        ///< kept
  std::size_t lostPictures = 0; ///< there was no room; the tick itself was kept
  std::size_t lostTicks = 0;    ///< there was no room at all
  std::uint64_t bytes = 0;      ///< of all bags
  std::string problem;          ///< why it ended early; empty: it did not
};

/** The bags of a recording that are there: drive.bag, drive_1.bag, drive_2.bag and so on. */
std::vector<std::filesystem::path> bagParts(const std::filesystem::path &first);

/**
 * Writes the ticks of a run into bags, in a thread of its own.
 *
 * What ROS has messages for is written as such, each with a time 1 ns after the one before, and
 * after the messages of a tick an event that says the rest of it, to the last digit. The first
 * event of each bag says what is recorded.
 */
class TickRecorder
{
public:
  /**
   * @param path of the first bag
   * @param setup JSON of what is recorded, for whoever replays it
   * @throw StoreError when the bag cannot be written, or one of its parts exists
   */
  TickRecorder(const std::filesystem::path &path, const std::string &setup,
               const RecorderOptions &options);

  /** As finish(). */
  ~TickRecorder();

  /** Takes a tick; throws nothing, see RecordingCounts::problem. */
  void keep(Tick tick);

  /** Writes what waits and closes the bag. */
  RecordingCounts finish();

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

} // namespace homeward
