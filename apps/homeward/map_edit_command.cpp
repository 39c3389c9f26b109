// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "node_argument.h"

#include <homeward/core/error.h>
#include <homeward/place/same_place.h>
#include <homeward/store/map_file.h>
#include <homeward/upkeep/same_places.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>

namespace homeward
{
namespace
{

struct EditArguments
{
  std::string map;
  std::string node;
  std::string other;
  std::string name;
  double turn = std::numeric_limits<double>::quiet_NaN(); ///< degrees; none: by sight
  bool force = false;
  bool lift = false;
};

std::string numberText(NodeId node)
{
  return std::to_string(node.value);
}

/** Makes an edit and says so; what breaks a rule of the map is the user's mistake. */
void edit(MapFile &file, const std::string &description, const MapChange &change)
{
  std::int64_t number = 0;
  try {
    number = file.edit(description, {.changes = {change}});
  }
  catch (const LogicError &error) {
    throw ConfigError("map " + file.path().string() + " cannot have that: " + error.what());
  }
  file.close();
  std::printf("edit %lld: %s\n", static_cast<long long>(number), description.c_str());
}

void rename(const EditArguments &arguments)
{
  MapFile file = MapFile::open(arguments.map);
  const NodeId node = nodeOf(file, arguments.node);
  const std::string what = arguments.name.empty()
                               ? "node " + numberText(node) + " has no name"
                               : "node " + numberText(node) + " is " + arguments.name;
  edit(file, what, NodeNamed{node, arguments.name});
}

void remove(const EditArguments &arguments)
{
  MapFile file = MapFile::open(arguments.map);
  const NodeId node = nodeOf(file, arguments.node);
  edit(file, "node " + numberText(node) + " is deleted", NodeRemoved{node});
}

/** The turn from one node's heading to the other's, radians. @throw RuntimeError when they differ
 */
double turnBetween(const MapFile &file, NodeId kept, NodeId gone, const EditArguments &arguments)
{
  if (!std::isnan(arguments.turn) && arguments.force) {
    return radians(arguments.turn);
  }
  const PlaceLook look = comparePlaces(file.panorama(kept), file.panorama(gone));
  const std::string pair = "nodes " + numberText(kept) + " and " + numberText(gone);
  if (look.probability < kSureProbability && !arguments.force) {
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.0f %%", 100.0 * look.probability);
    throw RuntimeError(pair + " do not look like one place (" + percent + "); --force if they are");
  }
  if (!std::isnan(arguments.turn)) {
    return radians(arguments.turn);
  }
  if (!look.turn) {
    throw RuntimeError("the pictures of " + pair + " show no heading; give --turn");
  }
  return *look.turn;
}

void merge(const EditArguments &arguments)
{
  MapFile file = MapFile::open(arguments.map);
  const NodeId kept = nodeOf(file, arguments.node);
  const NodeId gone = nodeOf(file, arguments.other);
  const double turn = turnBetween(file, kept, gone, arguments);
  char angle[32];
  std::snprintf(angle, sizeof angle, "%.0f", degrees(wrapAngle(turn)));
  edit(file,
       "node " + numberText(gone) + " is node " + numberText(kept) + ", turned by " + angle +
           " degrees",
       NodesMerged{kept, gone, turn});
}

void forbid(const EditArguments &arguments)
{
  MapFile file = MapFile::open(arguments.map);
  const NodeId a = nodeOf(file, arguments.node);
  const NodeId b = nodeOf(file, arguments.other);
  const std::optional<Edge> edge = file.map().edgeBetween(a, b);
  if (!edge) {
    throw ConfigError("map " + file.path().string() + " has no edge between node " + numberText(a) +
                      " and node " + numberText(b));
  }
  edit(file,
       "the edge " + numberText(a) + " - " + numberText(b) +
           (arguments.lift ? " may be driven" : " is no-go"),
       EdgeForbidden{edge->id, !arguments.lift});
}

void undo(const EditArguments &arguments)
{
  MapFile file = MapFile::open(arguments.map);
  const JournalEntry entry = file.undo();
  file.close();
  std::printf("undone edit %lld: %s\n", static_cast<long long>(entry.number),
              entry.description.c_str());
}

void journal(const EditArguments &arguments)
{
  const MapFile file = MapFile::open(arguments.map, MapFile::Access::Read);
  for (const JournalEntry &entry : file.journal()) {
    std::printf("edit %lld: %s%s\n", static_cast<long long>(entry.number),
                entry.description.c_str(), entry.undone ? " (undone)" : "");
  }
}

} // namespace

void addMapEditCommand(CliCommand map)
{
  auto arguments = std::make_shared<EditArguments>();
  CliCommand editCommand = map.command("edit", "Change it by hand; every edit can be undone");
  editCommand.requireCommand();
  const auto command = [&](const std::string &name, const std::string &what,
                           const std::string &example, void (*action)(const EditArguments &)) {
    CliCommand made = editCommand.command(name, what);
    made.examples("Example: homeward map edit " + example);
    made.option("map", arguments->map, "Map file").required();
    made.run([arguments, action] {
      action(*arguments);
      return kExitDone;
    });
    return made;
  };

  CliCommand renaming =
      command("rename", "Give a node a name", "rename lab.hwm 12 \"the kitchen\"", rename);
  renaming.option("node", arguments->node, "Node, number or name").required();
  renaming.option("name", arguments->name, "Its new name, \"\" for none").required();

  CliCommand merging =
      command("merge", "Make one node of two at the same place", "merge lab.hwm 3 17", merge);
  merging.option("kept", arguments->node, "Node that stays").required();
  merging.option("gone", arguments->other, "Node that becomes one with it").required();
  merging.option("--turn", arguments->turn,
                 "Heading of the second less that of the first, degrees (default: by sight)");
  merging.flag("--force", arguments->force, "Even if they do not look like one place");

  CliCommand deleting =
      command("delete", "Remove a node and its edges", "delete lab.hwm 17", remove);
  deleting.option("node", arguments->node, "Node, number or name").required();

  CliCommand forbidding = command("no-go", "Never plan over an edge", "no-go lab.hwm 3 4", forbid);
  forbidding.option("a", arguments->node, "Node at one end").required();
  forbidding.option("b", arguments->other, "Node at the other end").required();
  forbidding.flag("--lift", arguments->lift, "Let it be driven again");

  command("undo", "Take back the newest edit that was not undone yet", "undo lab.hwm", undo);
  command("journal", "List the edits", "journal lab.hwm", journal);
}

} // namespace homeward
