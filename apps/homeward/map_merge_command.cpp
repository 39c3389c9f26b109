// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "files.h"

#include <homeward/core/error.h>
#include <homeward/upkeep/merge_maps.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace homeward
{
namespace
{

struct MergeArguments
{
  std::string a;
  std::string b;
  std::string output;
  std::string json;
  bool overwrite = false;
};

void merge(const MergeArguments &arguments)
{
  const MapFile a = MapFile::open(arguments.a, MapFile::Access::Read);
  const MapFile b = MapFile::open(arguments.b, MapFile::Access::Read);
  const auto alike = alikePlaces(a, b);
  const auto pairs = agreeingPairs(a.map(), b.map(), alike);
  if (pairs.empty()) {
    throw RuntimeError("the maps " + arguments.a + " and " + arguments.b +
                       " have no place in common for sure; nothing is written");
  }
  const auto became =
      mergeMaps(a, b, pairs, arguments.output,
                arguments.overwrite ? MapFile::IfExists::Replace : MapFile::IfExists::Refuse);
  nlohmann::json nodes = nlohmann::json::array();
  for (const auto &[old, now] : became) {
    const auto pair = std::find_if(pairs.begin(), pairs.end(),
                                   [id = old](const PlacePair &one) { return one.b == id; });
    nodes.push_back({{"of_b", old.value}, {"node", now.value}});
    if (pair == pairs.end()) {
      std::printf("node %lld of %s is new: %lld\n", static_cast<long long>(old.value),
                  arguments.b.c_str(), static_cast<long long>(now.value));
      continue;
    }
    nodes.back()["probability"] = pair->probability;
    nodes.back()["turn_rad"] = pair->turn;
    std::printf("node %lld of %s is node %lld of %s, turned by %.0f degrees (%.1f %%)\n",
                static_cast<long long>(old.value), arguments.b.c_str(),
                static_cast<long long>(now.value), arguments.a.c_str(), degrees(pair->turn),
                100.0 * pair->probability);
  }
  std::printf("%s: %zu nodes of %s, %zu of them known to %s\n", arguments.output.c_str(),
              became.size(), arguments.b.c_str(), pairs.size(), arguments.a.c_str());
  nlohmann::json json = jsonHeader("map merge");
  json["nodes"] = nodes;
  json["pairs"] = pairs.size();
  json["alike"] = alike.size();
  writeJson(arguments.json, json);
}

} // namespace

void addMapMergeCommand(CliCommand map)
{
  auto arguments = std::make_shared<MergeArguments>();
  CliCommand command = map.command("merge", "Make one map of two of the same building");
  command.examples("Example: homeward map merge monday.hwm tuesday.hwm --out building.hwm");
  command.option("a", arguments->a, "Map file").required();
  command.option("b", arguments->b, "Map file whose places are added").required();
  command.option("-o,--out", arguments->output, "Map file to write").required();
  command.flag("--overwrite", arguments->overwrite, "Replace an existing map");
  command.json(arguments->json, "which node became which");
  command.run([arguments] {
    merge(*arguments);
    return kExitDone;
  });
}

} // namespace homeward
