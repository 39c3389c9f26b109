// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/bag/tick_recorder.h>

#include "tick_messages.h"

#include <homeward/bag/bag_writer.h>
#include <homeward/core/error.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace homeward
{
namespace fs = std::filesystem;

namespace
{

fs::path partName(const fs::path &first, std::size_t number)
{
  if (number == 0) {
    return first;
  }
  return first.parent_path() /
         (first.stem().string() + "_" + std::to_string(number) + first.extension().string());
}

std::size_t bytesOf(const Frame &frame)
{
  return frame.image.total() * frame.image.elemSize();
}

/** What a tick holds, about. */
std::size_t bytesOf(const Tick &tick)
{
  constexpr std::size_t kReadings = 4000;
  std::size_t bytes = kReadings;
  for (const std::optional<Frame> &frame : tick.frames) {
    bytes += frame ? bytesOf(*frame) : 0;
  }
  return bytes;
}

/** ROS time at zero of robot time, when that is now. */
Duration epochNow(Time now)
{
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()) -
         now.time_since_epoch();
}

} // namespace

std::vector<fs::path> bagParts(const fs::path &first)
{
  std::vector<fs::path> parts;
  for (fs::path part = first; fs::exists(part); part = partName(first, parts.size())) {
    parts.push_back(part);
  }
  return parts;
}

class TickRecorder::Impl
{
public:
  Impl(const fs::path &first, const std::string &setup, const RecorderOptions &options)
      : m_first(first), m_setup(nlohmann::json::parse(setup)), m_options(options)
  {
    if (!bagParts(first).empty()) {
      throw StoreError("the bag " + first.string() + " exists; give another name or remove it");
    }
    m_bag = std::make_unique<BagWriter>(first);
    m_thread = std::thread([this] { work(); });
  }

  ~Impl() { finish(); }

  Impl(const Impl &) = delete;
  Impl &operator=(const Impl &) = delete;

  void keep(Tick tick)
  {
    std::unique_lock lock(m_mutex);
    if (m_options.mayWait) {
      m_changed.wait(lock, [this] { return m_waitingBytes < m_options.waitingBytes; });
    }
    else if (!makeRoom(tick)) {
      ++m_counts.lostTicks;
      return;
    }
    m_waitingBytes += bytesOf(tick);
    m_waiting.push_back(std::move(tick));
    m_changed.notify_all();
  }

  RecordingCounts finish()
  {
    {
      const std::lock_guard lock(m_mutex);
      m_finished = true;
      m_changed.notify_all();
    }
    if (m_thread.joinable()) {
      m_thread.join();
      try {
        closeBag();
      }
      catch (const std::exception &error) {
        m_counts.problem = m_counts.problem.empty() ? error.what() : m_counts.problem;
      }
    }
    return m_counts;
  }

private:
  /** Drops pictures that do not fit. @return false when nothing fits */
  bool makeRoom(Tick &tick)
  {
    for (std::optional<Frame> &frame : tick.frames) {
      if (frame && m_waitingBytes + bytesOf(tick) > m_options.waitingBytes) {
        frame->image.release();
        ++m_counts.lostPictures;
      }
    }
    // What has no pictures may take a little more, lest the order of things is lost.
    return m_waitingBytes + bytesOf(tick) <= m_options.waitingBytes + m_options.waitingBytes / 4;
  }

  void work()
  {
    while (const std::optional<Tick> tick = take()) {
      try {
        if (m_counts.problem.empty()) {
          write(*tick);
          ++m_counts.ticks;
        }
      }
      catch (const std::exception &error) {
        m_counts.problem = error.what();
      }
    }
  }

  /** The next tick; nothing when there will be none. */
  std::optional<Tick> take()
  {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, [this] { return !m_waiting.empty() || m_finished; });
    if (m_waiting.empty()) {
      return std::nullopt;
    }
    Tick tick = std::move(m_waiting.front());
    m_waiting.pop_front();
    m_waitingBytes -= bytesOf(tick);
    m_changed.notify_all();
    return tick;
  }

  void write(const Tick &tick)
  {
    if (!m_encoder) {
      m_epoch = epochNow(tick.begin());
      m_encoder.emplace(m_epoch);
      begin();
    }
    if (m_bag->size() > m_options.fileBytes) {
      closeBag();
      m_bag = std::make_unique<BagWriter>(partName(m_first, ++m_part));
      begin();
    }
    for (const BagMessage &message : m_encoder->encode(tick)) {
      m_bag->write(message);
    }
  }

  void begin()
  {
    m_encoder->beginBag();
    m_bag->write(m_encoder->event({{"event", "recording"},
                                   {"version", 1},
                                   {"part", m_part},
                                   {"epoch_ns", m_epoch.count()},
                                   {"setup", m_setup}}));
  }

  void closeBag()
  {
    m_bag->close();
    m_counts.bytes += fs::file_size(partName(m_first, m_part));
  }

  fs::path m_first;
  nlohmann::json m_setup;
  RecorderOptions m_options;
  std::unique_ptr<BagWriter> m_bag;
  std::optional<TickEncoder> m_encoder;
  Duration m_epoch{};
  std::size_t m_part = 0;
  RecordingCounts m_counts; ///< lost ones under the mutex, the rest of the thread

  std::mutex m_mutex;
  std::condition_variable m_changed;
  std::deque<Tick> m_waiting;
  std::size_t m_waitingBytes = 0;
  bool m_finished = false;
  std::thread m_thread; ///< last: it uses all of them
};

TickRecorder::TickRecorder(const fs::path &path, const std::string &setup,
                           const RecorderOptions &options)
    : m_impl(std::make_unique<Impl>(path, setup, options))
{}

TickRecorder::~TickRecorder() = default;

void TickRecorder::keep(Tick tick)
{
  m_impl->keep(std::move(tick));
}

RecordingCounts TickRecorder::finish()
{
  return m_impl->finish();
}

} // namespace homeward
