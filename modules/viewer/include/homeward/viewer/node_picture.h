// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/camera/panorama.h>
#include <homeward/topology/map.h>

#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** A place whose panorama was compared with that of another one. */
struct AlikePlace
{
  NodeId node;              ///< that it is compared with
  double distance = 0.0;    ///< of the two panoramas' signatures, 0 (equal) or more
  double probability = 0.0; ///< that the two are one place, 0 to 1
};

/** What a picture of one place shows besides what the map's graph says of it. */
struct NodePicture
{
  std::string title;                ///< above the picture; empty for none
  int width = 1200;                 ///< of the picture, pixels; the height follows
  std::optional<Panorama> panorama; ///< 8 bits, gray or BGR; none where the map has none
  std::vector<AlikePlace> alike;    ///< most alike first
};

/**
 * One place of a map as SVG: its panorama over a scale of bearings, below it the place from above,
 * with its stored heading on top: directions as sectors of their width in the colour of their
 * state, neighbours where their edges lead, in metres (those of unknown length on the rim). Beside
 * it, in words, directions, neighbours and the places that look most alike. Columns that are too
 * narrow for their words end them with dots. The same input gives the same text.
 * @throw LogicError when the node is unknown, the panorama's size is not that of its geometry, or
 * the width is below 800
 */
std::string nodeSvg(const TopologicalMap &map, NodeId node, const NodePicture &picture);

/** The same as a picture, CV_8UC3 BGR. */
cv::Mat nodeImage(const TopologicalMap &map, NodeId node, const NodePicture &picture);

} // namespace homeward
