// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "symbols.h"

#include <homeward/viewer/node_picture.h>

namespace homeward
{

/** A column of words. */
struct TableColumn
{
  std::string head;
  double share = 1.0; ///< of the table's width; of all columns 1
};

/** Words in rows and columns, with the symbol of a direction before a row or without. */
struct NodeTable
{
  static constexpr double kHeadHeight = 50.0; ///< title and heads, pixels
  static constexpr double kRowHeight = 18.0;  ///< pixels
  static constexpr double kGap = 20.0;        ///< below, pixels

  std::string title;
  std::vector<TableColumn> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<DirectionState> states = {}; ///< of each row, or none

  /** With the gap below it, pixels. */
  double height() const;

  /** @param corner upper left; width pixels */
  void draw(Canvas &canvas, const Point &corner, double width) const;
};

/** "+90 deg", left positive; "unknown" without one. @param bearing radians */
std::string bearingText(const std::optional<double> &bearing);

/** Directions, neighbours and look-alikes of a node. */
std::vector<NodeTable> nodeTables(const TopologicalMap &map, NodeId node,
                                  const std::vector<AlikePlace> &alike);

} // namespace homeward
