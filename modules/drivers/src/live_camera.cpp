// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/core/error.h>
#include <homeward/drivers/live_camera.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace homeward
{
namespace
{

constexpr Duration kPause = std::chrono::milliseconds(20);

bool equal(const cv::Mat &a, const cv::Mat &b)
{
  if (a.size() != b.size() || a.type() != b.type()) {
    return false;
  }
  const std::size_t bytes = static_cast<std::size_t>(a.cols) * a.elemSize();
  for (int row = 0; row < a.rows; ++row) {
    if (std::memcmp(a.ptr(row), b.ptr(row), bytes) != 0) {
      return false;
    }
  }
  return true;
}

} // namespace

LiveCamera::LiveCamera(std::unique_ptr<ImageSource> source, const CaptureOptions &options)
    : m_source(std::move(source)), m_options(options), m_clock(options.clockRate),
      m_thread([this](const std::stop_token &stop) { run(stop); })
{
  const Time deadline = m_clock.now() + m_options.start;
  while (m_clock.now() < deadline) {
    {
      const std::lock_guard lock(m_knowing);
      if (m_counters.taken > 0 || m_ended) {
        return;
      }
    }
    m_clock.sleepUntil(m_clock.now() + kPause);
  }
  const std::lock_guard lock(m_knowing);
  throw DeviceError("the camera opened but sends no pictures" +
                    (m_trouble.empty() ? "" : ": " + m_trouble));
}

LiveCamera::~LiveCamera() = default;

void LiveCamera::run(const std::stop_token &stop)
{
  Time due = m_clock.now();
  while (!stop.stop_requested() && takeNext()) {
    due = std::max(due + m_options.period, m_clock.now());
    m_clock.sleepUntil(due);
  }
}

bool LiveCamera::takeNext()
{
  try {
    if (std::optional<Frame> frame = m_source->grab()) {
      take(std::move(*frame));
      return true;
    }
    const std::lock_guard lock(m_knowing);
    m_ended = true;
    return false;
  }
  catch (const std::exception &error) {
    const std::lock_guard lock(m_knowing);
    m_trouble = error.what();
  }
  m_clock.sleepUntil(m_clock.now() + kPause);
  return true;
}

void LiveCamera::take(Frame frame)
{
  const std::lock_guard lock(m_knowing);
  ++m_counters.taken;
  m_trouble.clear();
  if (equal(frame.image, m_frame.image)) {
    ++m_counters.repeated;
    return;
  }
  m_counters.dropped += m_fresh ? 1U : 0U;
  m_heard = m_clock.now();
  m_frame = {m_heard - m_options.latency, std::move(frame.image)};
  m_fresh = true;
}

std::optional<Frame> LiveCamera::grab()
{
  const std::lock_guard lock(m_knowing);
  if (m_ended && !m_fresh) {
    return std::nullopt;
  }
  const Duration age = m_clock.now() - m_heard;
  if (!m_ended && age > m_options.silence) {
    throw DeviceError("the camera has sent nothing new for " + std::to_string(toSeconds(age)) +
                      " s" + (m_trouble.empty() ? "" : ": " + m_trouble));
  }
  m_counters.used += m_fresh ? 1U : 0U;
  m_fresh = false;
  return Frame{m_frame.stamp, m_frame.image.clone()};
}

std::optional<Time> LiveCamera::newest() const
{
  const std::lock_guard lock(m_knowing);
  return m_heard;
}

CaptureCounters LiveCamera::counters() const
{
  const std::lock_guard lock(m_knowing);
  return m_counters;
}

} // namespace homeward
