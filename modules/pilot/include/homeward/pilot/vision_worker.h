// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/time.h>
#include <homeward/robot/clock.h>

#include <future>
#include <optional>
#include <utility>

namespace homeward
{

/**
 * One thread for perception, so that the control loop never waits for it. A result is delivered at
 * a fixed robot time after its request: simulated runs come out the same however long the computing
 * took.
 */
template <class Result> class VisionWorker
{
public:
  /** @param latency robot time from request to delivery */
  explicit VisionWorker(Duration latency) : m_latency(latency) {}

  /** A request is under way. */
  bool busy() const { return m_pending.valid(); }

  /** Starts `work`, a call without arguments. The worker must not be busy. */
  template <class Work> void request(Time now, Work &&work)
  {
    m_due = now + m_latency;
    m_pending = std::async(std::launch::async, std::forward<Work>(work));
  }

  /**
   * The result of the request under way, once its time has come. In simulation the caller then
   * waits for the computation; a real robot's loop passes `wait` false and asks again at its next
   * tick.
   * @param clock says whether it counts as done, see Clock::counts()
   */
  std::optional<Result> deliver(Time now, bool wait, Clock &clock)
  {
    if (!m_pending.valid() || now < m_due) {
      return std::nullopt;
    }
    if (!wait && !clock.counts(m_pending.wait_for(Duration::zero()) == std::future_status::ready)) {
      return std::nullopt;
    }
    return m_pending.get();
  }

private:
  Duration m_latency;
  Time m_due{};
  std::future<Result> m_pending;
};

} // namespace homeward
