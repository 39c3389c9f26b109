// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/core/pose2.h>

#include <string>

namespace homeward
{

/**
 * A URDF document whose joint to the link `mirror` stands elsewhere in the plane; its height, roll
 * and pitch stay, and so does all the rest.
 * @param xml the document
 * @param origin the file's name, for messages
 * @param rMp the mirror's place in the robot's frame
 * @throw ConfigError when it is no URDF, has no joint to `mirror`, or that joint hangs on a link
 * other than base_link
 */
std::string withMirrorAt(const std::string &xml, const std::string &origin, const Pose2 &rMp);

} // namespace homeward
