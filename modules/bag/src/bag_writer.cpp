// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/bag/bag_writer.h>

#include "ros_error.h"

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <opencv2/imgcodecs.hpp>
#include <rosbag/bag.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace homeward
{
namespace
{

ros::Time toRos(Time at)
{
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t nanoseconds = std::max<std::int64_t>(1, at.time_since_epoch().count());
  return {static_cast<std::uint32_t>(nanoseconds / kSecond),
          static_cast<std::uint32_t>(nanoseconds % kSecond)};
}

std_msgs::Header header(Time stamp, const char *frame)
{
  std_msgs::Header made;
  made.stamp = toRos(stamp);
  made.frame_id = frame;
  return made;
}

geometry_msgs::Twist toRos(const Twist2 &twist)
{
  geometry_msgs::Twist made;
  made.linear.x = twist.v;
  made.angular.z = twist.w;
  return made;
}

nav_msgs::Odometry toRos(const BaseState &state)
{
  nav_msgs::Odometry made;
  made.header = header(state.stamp, "odom");
  made.child_frame_id = "base_link";
  made.pose.pose.position.x = state.odometry.x;
  made.pose.pose.position.y = state.odometry.y;
  made.pose.pose.orientation.z = std::sin(state.odometry.heading / 2.0);
  made.pose.pose.orientation.w = std::cos(state.odometry.heading / 2.0);
  made.twist.twist = toRos(state.velocity);
  return made;
}

sensor_msgs::LaserScan toRos(const Scan &scan)
{
  sensor_msgs::LaserScan made;
  made.header = header(scan.stamp, "laser");
  made.angle_min = static_cast<float>(scan.angleMin);
  made.angle_increment = static_cast<float>(scan.angleStep);
  made.angle_max =
      static_cast<float>(scan.ranges.empty() ? scan.angleMin : scan.angle(scan.ranges.size() - 1));
  made.range_max = static_cast<float>(scan.rangeMax);
  made.ranges = scan.ranges;
  return made;
}

sensor_msgs::CompressedImage toRos(const Frame &frame)
{
  constexpr int kQuick = 1; // PNG level: noise does not shrink however long one tries
  sensor_msgs::CompressedImage made;
  made.header = header(frame.stamp, "camera");
  made.format = frame.image.channels() == 3 ? "bgr8; png compressed bgr8" : "mono8; png compressed";
  cv::imencode(".png", frame.image, made.data, {cv::IMWRITE_PNG_COMPRESSION, kQuick});
  return made;
}

std_msgs::String toRos(const BagEvent &event)
{
  std_msgs::String made;
  made.data = event.json;
  return made;
}

const std::string &topicOf(const BagTopics &topics, const BagMessage &message)
{
  const std::string *names[] = {&topics.odometry, &topics.scan, &topics.image, &topics.command,
                                &topics.events};
  return *names[message.what.index()];
}

} // namespace

class BagWriter::Impl
{
public:
  Impl(std::filesystem::path file, BagTopics names)
      : path(std::move(file)), topics(std::move(names))
  {}

  template <class Work> void guarded(Work work)
  {
    withBag(path, "is the disk full or the folder missing?", work);
  }

  std::filesystem::path path;
  BagTopics topics;
  rosbag::Bag bag;
};

BagWriter::BagWriter(const std::filesystem::path &path, BagTopics topics)
    : m_impl(std::make_unique<Impl>(path, std::move(topics)))
{
  m_impl->guarded([&] { m_impl->bag.open(path.string(), rosbag::bagmode::Write); });
}

BagWriter::~BagWriter()
{
  try {
    close();
  }
  catch (const StoreError &) {
    return; // who wants to know calls close()
  }
}

void BagWriter::write(const BagMessage &message)
{
  m_impl->guarded([&] {
    std::visit(
        [&](const auto &what) {
          m_impl->bag.write(topicOf(m_impl->topics, message), toRos(message.at), toRos(what));
        },
        message.what);
  });
}

std::uint64_t BagWriter::size() const
{
  return m_impl->bag.getSize();
}

void BagWriter::close()
{
  m_impl->guarded([&] { m_impl->bag.close(); });
}

} // namespace homeward
