// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/store/map_file.h>
#include <homeward/viewer/mission_picture.h>

#include <map>
#include <string>

namespace homeward
{

/** What a page draws of a mission, as events: "state", "view" and "scan" where there are such. */
std::map<std::string, std::string> sceneJson(const MissionScene &scene);

/**
 * What it draws of a map: nodes in metres as the ways reckon them, from the first one on. Where the
 * lengths of ways are not known, one way is about one metre.
 */
std::string mapJson(const MapFile &file);

} // namespace homeward
