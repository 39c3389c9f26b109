// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace homeward
{

/** An upright prism of the robot's body: its rectangle on the floor and the heights it fills. */
struct BodyPart
{
  std::string link;  ///< name of the URDF link
  double xMin = 0.0; ///< metres in the robot's frame
  double xMax = 0.0; ///< front, metres
  double yMin = 0.0; ///< right side, metres
  double yMax = 0.0; ///< left side, metres
  double zMin = 0.0; ///< metres above the floor
  double zMax = 0.0; ///< upper side, metres
};

/** A sonar transducer in the robot's frame. */
struct SonarMount
{
  double x = 0.0;       ///< metres
  double y = 0.0;       ///< metres, left
  double z = 0.0;       ///< metres, up from the floor
  double bearing = 0.0; ///< radians
};

/**
 * What the rest needs to know of a robot's shape. Frame r: on the floor under the middle of the
 * wheels, x forward, y left, z up.
 */
struct RobotDescription
{
  std::string name;                                      ///< as its file has it
  std::vector<BodyPart> body;                            ///< boxes that it is made of
  Eigen::Isometry3d rMl = Eigen::Isometry3d::Identity(); ///< the laser's frame
  Eigen::Isometry3d rMp = Eigen::Isometry3d::Identity(); ///< the mirror's focus
  std::vector<SonarMount> sonars;                        ///< in the order of their numbers
  double wheelRadius = 0.0;                              ///< metres
  double track = 0.0;                                    ///< metres between left and right wheels

  /** The rectangle on the floor around every body part. zMin and zMax span the body. */
  BodyPart footprint() const;
};

/**
 * Reads a URDF document. Body parts come from the `<collision>` boxes, cylinders and spheres of
 * links fixed to `base_link` or turning wheels; links named `laser`, `mirror` and `sonar_<n>` are
 * the frames; wheel joints are continuous and named `*wheel*`.
 * @param xml the document
 * @param origin the file's name, for messages
 * @throw ConfigError naming what is missing or wrong
 */
RobotDescription parseRobotDescription(const std::string &xml, const std::string &origin);

} // namespace homeward
