// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace homeward
{

/**
 * Calls work(0) to work(count - 1), in any order, on so many threads. Of several exceptions, the
 * one of the smallest index is passed on, after all work.
 */
template <class Work> void inParallel(std::size_t count, int threads, const Work &work)
{
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t failedAt = count;
  std::exception_ptr failure;
  const auto run = [&] {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
      try {
        work(i);
      }
      catch (...) {
        const std::lock_guard lock(mutex);
        if (i < failedAt) {
          failedAt = i;
          failure = std::current_exception();
        }
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) {
      helpers.emplace_back(run);
    }
    run();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

} // namespace homeward
