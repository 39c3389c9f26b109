// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/scan.h>
#include <homeward/robot/image_source.h>
#include <homeward/robot/mobile_base.h>

#include <optional>
#include <string>
#include <variant>

namespace homeward
{

/** Names of what a bag holds. */
struct BagTopics
{
  std::string image = "/camera/image/compressed"; ///< sensor_msgs/CompressedImage or Image
  std::string scan = "/scan";                     ///< sensor_msgs/LaserScan, frame "laser"
  std::string odometry = "/odom";                 ///< nav_msgs/Odometry, "odom" to "base_link"
  std::string command = "/cmd_vel";               ///< geometry_msgs/Twist
  std::string events = "/homeward/events";        ///< std_msgs/String, JSON
};

/** The JSON of an event. */
struct BagEvent
{
  std::string json; ///< one value
};

/** A message. Of a BaseState only stamp, odometry and velocity are told. */
struct BagMessage
{
  Time at{}; ///< when it was written; ROS time counts as robot time
  std::variant<BaseState, Scan, Frame, Twist2, BagEvent> what; ///< its content
};

} // namespace homeward
