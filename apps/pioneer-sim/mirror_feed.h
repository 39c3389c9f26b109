// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "faults.h"

#include <homeward/core/pose2.h>
#include <homeward/sim/mirror_renderer.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace homeward
{

/** What the camera of the simulated robot is like. */
struct MirrorFeedOptions
{
  std::chrono::nanoseconds period = std::chrono::milliseconds(200); ///< between pictures
  int quality = 95;                                                 ///< of the JPEGs, 1 to 100
};

/**
 * Pictures of the mirror camera as JPEG, made by a thread of its own while somebody looks. Who is
 * slow misses some and makes nobody wait.
 */
class MirrorFeed
{
public:
  /** A picture and its number, which grows. */
  struct Picture
  {
    std::uint64_t number = 0;
    std::shared_ptr<const std::string> jpeg; ///< null before the first one
  };

  /** Asks for pictures as long as it lives. */
  class Viewer
  {
  public:
    explicit Viewer(MirrorFeed &feed) : m_feed(feed) { feed.addViewers(1); }
    ~Viewer() { m_feed.addViewers(-1); }
    Viewer(const Viewer &) = delete;
    Viewer &operator=(const Viewer &) = delete;

    /** One newer than the last; its `jpeg` is null when none came within `patience`. */
    Picture next(std::chrono::milliseconds patience);

  private:
    MirrorFeed &m_feed;
    std::uint64_t m_last = 0;
  };

  /**
   * @param pose wMr now; called on the feed's thread
   * @param rMp the mirror's focus in the robot's frame
   */
  MirrorFeed(MirrorRenderer renderer, const Eigen::Isometry3d &rMp, std::function<Pose2()> pose,
             std::uint64_t seed, const MirrorFeedOptions &options, const Faults &faults);
  ~MirrorFeed();
  MirrorFeed(const MirrorFeed &) = delete;
  MirrorFeed &operator=(const MirrorFeed &) = delete;

private:
  void addViewers(int count);
  void run(const std::stop_token &stop);
  std::shared_ptr<const std::string> take();
  void show(std::shared_ptr<const std::string> jpeg);

  MirrorRenderer m_renderer;
  Eigen::Isometry3d m_rMp;
  std::function<Pose2()> m_pose;
  Random m_noise;
  MirrorFeedOptions m_options;
  const Faults &m_faults;

  /** A picture on its way, and when it set out. */
  struct OnItsWay
  {
    std::chrono::steady_clock::time_point since;
    std::shared_ptr<const std::string> jpeg;
  };
  std::deque<OnItsWay> m_queue; ///< of the thread alone

  std::mutex m_mutex;
  std::condition_variable_any m_changed;
  int m_viewers = 0;
  Picture m_picture;
  std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace homeward
