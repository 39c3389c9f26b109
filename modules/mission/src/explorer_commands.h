// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "explorer_whereabouts.h"

#include <optional>
#include <vector>

namespace homeward
{

/** What an exploration can ask for: the commands that follow from its map and its state. */
class ExplorerCommands
{
public:
  /** All must outlive this; it says what holds for them as they are when it is asked. */
  ExplorerCommands(const ExplorerOptions &options, const TopologicalMap &map,
                   const ExplorerState &state)
      : m_options(options), m_map(map), m_state(state), m_whereabouts(options, map, state)
  {}

  /** The command that the state waits for an answer to. @throw LogicError when it is of no phase */
  Command pending() const;

  /** To the target. Where places far round are alike, only sight tells that it is the one. */
  HomeTo homeTo(std::optional<double> departure) const;

  /** To the place left by odometry, which is good enough over a few metres. */
  std::optional<DriveDirection> retreat() const;

  /** The next leg by its bearing and length, when it has failed and the map knows both. */
  std::optional<DriveDirection> stride() const;

  DriveDirection drive(const Direction &direction) const;

  /** The route to the nearest open direction over edges that failed seldom. */
  std::optional<std::vector<NodeId>> pathToOpen(NodeId node) const;

  bool tooManyNodes() const;

  /** How it ends when there is nothing left to do. */
  Finish ending() const;

private:
  const Direction &directionDriven() const;
  std::optional<Way> wayTo(NodeId node) const;

  const ExplorerOptions &m_options;
  const TopologicalMap &m_map;
  const ExplorerState &m_state;
  ExplorerWhereabouts m_whereabouts;
};

} // namespace homeward
