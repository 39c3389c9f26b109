// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/drivers/steady_clock.h>
#include <homeward/robot/image_source.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace homeward
{

/** How pictures are taken from a source that runs by itself. Durations are robot time. */
struct CaptureOptions
{
  Duration latency{};                         ///< from the light to the picture's arrival here
  Duration silence = std::chrono::seconds(3); ///< without a new picture: the camera counts as gone
  Duration start = std::chrono::seconds(10);  ///< the same for the first one
  Duration period{};                          ///< between pictures of a film; a camera sets its own
  double clockRate = 1.0;                     ///< see SteadyClock
};

/** How a camera gets on. */
struct CaptureCounters
{
  std::uint64_t taken = 0;    ///< pictures that came
  std::uint64_t used = 0;     ///< of which somebody wanted so many,
  std::uint64_t dropped = 0;  ///< a newer one came before anybody wanted so many
  std::uint64_t repeated = 0; ///< and so many were the one before once more: a frozen camera
};

/**
 * Any source of pictures in a thread of its own, the newest picture wins. A picture that equals the
 * last one to the bit is no new one, for no camera is without noise. A source in trouble is asked
 * again and again, so that a camera that comes back is there again.
 */
class LiveCamera final : public ImageSource
{
public:
  /** Waits for the first picture. @throw DeviceError when none comes */
  LiveCamera(std::unique_ptr<ImageSource> source, const CaptureOptions &options);
  ~LiveCamera() override;

  /** The newest picture, stamped when it was taken; nothing when the source has ended.
   * @throw DeviceError when nothing new has come for CaptureOptions::silence */
  std::optional<Frame> grab() override;

  std::optional<Time> newest() const override;

  /** What became of its pictures so far. */
  CaptureCounters counters() const;

private:
  void run(const std::stop_token &stop);
  bool takeNext();
  void take(Frame frame);

  std::unique_ptr<ImageSource> m_source;
  CaptureOptions m_options;
  SteadyClock m_clock;

  mutable std::mutex m_knowing;
  Frame m_frame;
  bool m_fresh = false; ///< nobody has had m_frame yet
  bool m_ended = false;
  Time m_heard{}; ///< when m_frame came
  CaptureCounters m_counters;
  std::string m_trouble; ///< why there is no newer picture; empty while all is well

  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
