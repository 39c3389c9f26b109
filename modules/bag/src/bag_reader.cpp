// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/bag/bag_reader.h>

#include "ros_error.h"

#include <homeward/core/angle.h>

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/String.h>

#include <cmath>
#include <set>

namespace homeward
{
namespace
{

Time fromRos(const ros::Time &time)
{
  return Time(Duration(static_cast<std::int64_t>(time.toNSec())));
}

Twist2 fromRos(const geometry_msgs::Twist &twist)
{
  return {twist.linear.x, twist.angular.z};
}

BaseState fromRos(const nav_msgs::Odometry &odometry)
{
  const auto &place = odometry.pose.pose.position;
  const auto &q = odometry.pose.pose.orientation;
  BaseState state;
  state.stamp = fromRos(odometry.header.stamp);
  state.odometry = {
      place.x, place.y,
      wrapAngle(std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)))};
  state.velocity = fromRos(odometry.twist.twist);
  return state;
}

/** Ranges that REP 117 calls too near, or that are none, are unknown; too far is far. */
Scan fromRos(const sensor_msgs::LaserScan &scan)
{
  Scan made;
  made.stamp = fromRos(scan.header.stamp);
  made.angleMin = scan.angle_min;
  made.angleStep = scan.angle_increment;
  made.rangeMax = scan.range_max;
  made.ranges = scan.ranges;
  for (float &range : made.ranges) {
    if (range < scan.range_min || !(range > 0.0F)) {
      range = kUnknownRange;
    }
  }
  return made;
}

Frame fromRos(const sensor_msgs::CompressedImage &image)
{
  Frame frame{fromRos(image.header.stamp), cv::imdecode(image.data, cv::IMREAD_UNCHANGED)};
  if (frame.image.type() != CV_8UC1 && frame.image.type() != CV_8UC3) {
    throw StoreError("a picture of " + std::to_string(toSeconds(frame.stamp)) +
                     " s cannot be read: its format is '" + image.format + "'");
  }
  return frame;
}

Frame fromRos(const sensor_msgs::Image &image)
{
  struct Encoding
  {
    const char *name;
    int type;
    int toBgr; ///< of cv::cvtColor; -1: as it is
  };
  constexpr Encoding kEncodings[] = {{"mono8", CV_8UC1, -1},
                                     {"bgr8", CV_8UC3, -1},
                                     {"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
                                     {"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
                                     {"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR}};
  for (const Encoding &encoding : kEncodings) {
    const std::size_t least = std::size_t{image.width} * CV_ELEM_SIZE(encoding.type);
    if (image.encoding != encoding.name || image.step < least ||
        image.data.size() < std::size_t{image.step} * image.height) {
      continue;
    }
    // The message goes; cv::Mat wants to write, and does not.
    const cv::Mat shown(static_cast<int>(image.height), static_cast<int>(image.width),
                        encoding.type, const_cast<std::uint8_t *>(image.data.data()), image.step);
    Frame frame{fromRos(image.header.stamp), {}};
    if (encoding.toBgr < 0) {
      frame.image = shown.clone();
    }
    else {
      cv::cvtColor(shown, frame.image, encoding.toBgr);
    }
    return frame;
  }
  throw StoreError("a picture of " + std::to_string(image.width) + " x " +
                   std::to_string(image.height) + ", encoding '" + image.encoding +
                   "', cannot be read; mono8, bgr8, rgb8, bgra8 and rgba8 can");
}

BagEvent fromRos(const std_msgs::String &text)
{
  return {text.data};
}

/** Reads a message when it is of this type. */
template <class Message>
bool read(const rosbag::MessageInstance &from, std::optional<BagMessage> &into)
{
  if (!from.isType<Message>()) {
    return false;
  }
  const auto message = from.instantiate<Message>();
  if (!message) {
    throw StoreError("a message of " + from.getTopic() + " cannot be read");
  }
  into = BagMessage{fromRos(from.getTime()), fromRos(*message)};
  return true;
}

} // namespace

class BagReader::Impl
{
public:
  Impl(std::filesystem::path path, const BagTopics &topics) : m_path(std::move(path))
  {
    if (!std::filesystem::exists(m_path)) {
      throw StoreError("the bag " + m_path.string() + " does not exist");
    }
    try {
      m_bag.open(m_path.string(), rosbag::bagmode::Read);
    }
    catch (const rosbag::BagUnindexedException &) {
      throw StoreError("the bag " + m_path.string() +
                       " was never closed and has no index; homeward replay --reindex " +
                       m_path.string() + " repairs it");
    }
    rosbag::View all(m_bag);
    const std::set<std::string> chosen{
        choose(all, topics.image, {"sensor_msgs/CompressedImage", "sensor_msgs/Image"}),
        choose(all, topics.scan, {"sensor_msgs/LaserScan"}),
        choose(all, topics.odometry, {"nav_msgs/Odometry"}),
        choose(all, topics.command, {"geometry_msgs/Twist"}),
        choose(all, topics.events, {"std_msgs/String"})};
    m_view.addQuery(m_bag, [chosen](const rosbag::ConnectionInfo *connection) {
      return chosen.count(connection->topic) > 0;
    });
    m_next = m_view.begin();
  }

  const std::filesystem::path &path() const { return m_path; }

  std::optional<BagMessage> next()
  {
    std::optional<BagMessage> message;
    for (; m_next != m_view.end() && !message; ++m_next) {
      // What is of another type though it has the topic's name is passed over.
      read<nav_msgs::Odometry>(*m_next, message) ||
          read<sensor_msgs::LaserScan>(*m_next, message) ||
          read<sensor_msgs::CompressedImage>(*m_next, message) ||
          read<sensor_msgs::Image>(*m_next, message) ||
          read<geometry_msgs::Twist>(*m_next, message) || read<std_msgs::String>(*m_next, message);
    }
    return message;
  }

private:
  /** The topic wanted, else the only one of the types, else none. */
  static std::string choose(rosbag::View &all, const std::string &wanted,
                            const std::set<std::string> &types)
  {
    std::set<std::string> found;
    for (const rosbag::ConnectionInfo *connection : all.getConnections()) {
      if (types.count(connection->datatype) > 0) {
        found.insert(connection->topic);
      }
    }
    if (found.count(wanted) > 0) {
      return wanted;
    }
    return found.size() == 1 ? *found.begin() : std::string();
  }

  std::filesystem::path m_path;
  rosbag::Bag m_bag;
  rosbag::View m_view;
  rosbag::View::iterator m_next;
};

BagReader::BagReader(const std::filesystem::path &path, const BagTopics &topics)
    : m_impl(
          withBag(path, "is it a ROS 1 bag?", [&] { return std::make_unique<Impl>(path, topics); }))
{}

BagReader::~BagReader() = default;

std::optional<BagMessage> BagReader::next()
{
  return withBag(m_impl->path(), "it is damaged", [this] { return m_impl->next(); });
}

} // namespace homeward
