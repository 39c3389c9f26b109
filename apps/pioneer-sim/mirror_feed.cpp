// SPDX-License-Identifier: GPL-3.0-or-later
#include "mirror_feed.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace homeward
{
namespace
{

constexpr std::uint32_t kNoiseStream = 301;
constexpr std::chrono::seconds kLateness{1}; ///< of pictures that queue up

Eigen::Isometry3d onTheFloor(const Pose2 &wMr)
{
  Eigen::Isometry3d spatial = Eigen::Isometry3d::Identity();
  spatial.translate(Eigen::Vector3d(wMr.x, wMr.y, 0.0));
  spatial.rotate(Eigen::AngleAxisd(wMr.heading, Eigen::Vector3d::UnitZ()));
  return spatial;
}

} // namespace

MirrorFeed::Picture MirrorFeed::Viewer::next(std::chrono::milliseconds patience)
{
  std::unique_lock lock(m_feed.m_mutex);
  const bool came = m_feed.m_changed.wait_for(lock, patience,
                                              [this] { return m_feed.m_picture.number > m_last; });
  if (!came) {
    return {};
  }
  m_last = m_feed.m_picture.number;
  return m_feed.m_picture;
}

MirrorFeed::MirrorFeed(MirrorRenderer renderer, const Eigen::Isometry3d &rMp,
                       std::function<Pose2()> pose, std::uint64_t seed,
                       const MirrorFeedOptions &options, const Faults &faults)
    : m_renderer(std::move(renderer)), m_rMp(rMp), m_pose(std::move(pose)),
      m_noise(seed, kNoiseStream), m_options(options), m_faults(faults),
      m_thread([this](const std::stop_token &stop) { run(stop); })
{}

MirrorFeed::~MirrorFeed()
{
  m_thread.request_stop();
  m_changed.notify_all();
}

void MirrorFeed::addViewers(int count)
{
  const std::lock_guard lock(m_mutex);
  m_viewers += count;
  m_changed.notify_all();
}

std::shared_ptr<const std::string> MirrorFeed::take()
{
  const cv::Mat picture = m_renderer.render(onTheFloor(m_pose()) * m_rMp, m_noise);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, m_options.quality});
  return std::make_shared<const std::string>(bytes.begin(), bytes.end());
}

void MirrorFeed::run(const std::stop_token &stop)
{
  auto due = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, stop, [this] { return m_viewers > 0; });
    m_changed.wait_until(lock, stop, due, [] { return false; });
    due = std::max(due + m_options.period, std::chrono::steady_clock::now());
    lock.unlock();
    if (stop.stop_requested() || m_faults.silentCamera) {
      continue;
    }
    const bool frozen = m_faults.frozenCamera && m_picture.jpeg; // only this thread writes it
    show(frozen ? m_picture.jpeg : take());
  }
}

void MirrorFeed::show(std::shared_ptr<const std::string> jpeg)
{
  const auto now = std::chrono::steady_clock::now();
  m_queue.push_back({now, std::move(jpeg)});
  const std::chrono::seconds lateness = m_faults.lateCamera ? kLateness : std::chrono::seconds(0);
  while (!m_queue.empty() && now - m_queue.front().since >= lateness) {
    const std::lock_guard lock(m_mutex);
    m_picture = {m_picture.number + 1, std::move(m_queue.front().jpeg)};
    m_queue.pop_front();
  }
  m_changed.notify_all();
}

} // namespace homeward
