// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace homeward
{

/**
 * Of each event the newest. Whoever writes holds the mutex for a moment only and waits for no
 * reader; a reader that comes late finds what is newest then.
 */
class EventBoard
{
public:
  using Text = std::shared_ptr<const std::string>;

  /** Puts an event up, in place of the one before. */
  void put(const std::string &event, const std::string &json)
  {
    // As the wire wants it. Made before the lock is taken.
    const auto text =
        std::make_shared<const std::string>("event: " + event + "\ndata: " + json + "\n\n");
    {
      const std::lock_guard lock(m_mutex);
      m_events[event] = {++m_count, text};
    }
    m_changed.notify_all();
  }

  /**
   * Waits for what is newer.
   * @param seen what the reader has; becomes what it has now
   * @return oldest first; empty when nothing came in time, or the board is closed
   */
  std::vector<Text> take(std::uint64_t &seen, std::chrono::milliseconds patience)
  {
    std::unique_lock lock(m_mutex);
    m_changed.wait_for(lock, patience, [&] { return m_closed || m_count > seen; });
    std::map<std::uint64_t, Text> newer;
    for (const auto &[event, entry] : m_events) {
      if (entry.number > seen) {
        newer[entry.number] = entry.text;
      }
    }
    seen = m_count;
    std::vector<Text> texts;
    texts.reserve(newer.size());
    for (const auto &[number, text] : newer) {
      texts.push_back(text);
    }
    return texts;
  }

  void close()
  {
    {
      const std::lock_guard lock(m_mutex);
      m_closed = true;
    }
    m_changed.notify_all();
  }

  bool closed() const
  {
    const std::lock_guard lock(m_mutex);
    return m_closed;
  }

private:
  struct Entry
  {
    std::uint64_t number = 0;
    Text text;
  };

  mutable std::mutex m_mutex;
  std::condition_variable m_changed;
  std::map<std::string, Entry> m_events;
  std::uint64_t m_count = 0;
  bool m_closed = false;
};

} // namespace homeward
