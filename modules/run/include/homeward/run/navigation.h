// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <homeward/mission/navigator.h>
#include <homeward/run/run_mission.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace homeward
{

/** What became of the drive to one goal. */
struct GoalReport
{
  NodeId goal;                       ///< where to
  Outcome outcome = Outcome::Failed; ///< how it ended
  std::string reason;                ///< why, in words
  std::vector<NodeId> path;          ///< nodes stood at, in order
  double seconds = 0.0;              ///< of robot time
  bool refreshed = false;            ///< the goal has a new picture
};

/**
 * Drives a pilot to one goal after another through a finished map. From the second goal on it knows
 * which node it stood at last, and its memory does not grow with the drives.
 */
class Navigation
{
public:
  /**
   * Makes the places of the map known to the pilot, which outlives the navigation as the clock
   * does.
   * @param kept the same file, open for writing, where the drives are to make the map better: how
   * legs went, and newer pictures of goals that no longer look as they did; null: nothing is kept
   */
  Navigation(const MapFile &file, Pilot &pilot, const Clock &clock, MapFile *kept = nullptr);

  /** The map, with a node for each picture that was added. */
  const TopologicalMap &map() const { return m_map; }

  /**
   * Makes a goal of the place where a picture was taken: a node of this navigation alone, one edge
   * from the likeliest place that the picture surely shows.
   * @param name of the new node, see Node::name
   * @return that place, with its probability; nothing, and no goal, where no place is sure
   * @throw LogicError for a name that a node cannot have
   */
  std::optional<PlaceMatch> addPicture(const std::string &name, const Panorama &picture);

  /**
   * Drives to a node of map().
   * @param maxSeconds of robot time after which it gives up
   * @throw LogicError when there is no such node
   */
  GoalReport driveTo(NodeId goal, double maxSeconds);

  /** Called with every step; may be empty. */
  std::function<void(const Step<NavigatorState> &)> onStep;

private:
  TopologicalMap m_map;
  MapFile *m_kept;
  Pilot &m_pilot;
  const Clock &m_clock;
  std::optional<NodeId> m_left; ///< the node stood at last
};

} // namespace homeward
