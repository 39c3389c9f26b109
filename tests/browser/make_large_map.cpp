// SPDX-License-Identifier: GPL-3.0-or-later
// make_large_map FILE: a map of 2000 places on a grid, for the page to draw.
#include <homeward/core/angle.h>
#include <homeward/store/map_file.h>

#include <cstdio>

namespace
{

constexpr int kColumns = 50;
constexpr int kRows = 40;
constexpr double kStep = 2.0; // metres

homeward::NodeId nodeAt(int column, int row)
{
  return {static_cast<std::int64_t>(row) * kColumns + column};
}

homeward::Node placeAt(int column, int row)
{
  using homeward::DirectionState;
  homeward::Node node;
  node.id = nodeAt(column, row);
  for (int i = 0; i < 4; ++i) {
    node.directions.push_back({{i},
                               homeward::wrapAngle(0.5 * homeward::kPi * i),
                               0.5,
                               i == 3 ? DirectionState::Open : DirectionState::Driven,
                               i == 3 ? "" : "driven"});
  }
  return node;
}

} // namespace

int main(int argc, char **argv)
{
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_large_map FILE\n");
    return 2;
  }
  homeward::MapHeader header;
  header.cameraHash = "none";
  header.signatureKind = "aligned-edges";
  homeward::MapFile file =
      homeward::MapFile::create(argv[1], header, homeward::MapFile::IfExists::Replace);
  homeward::MapUpdate update;
  std::int64_t edges = 0;
  const auto join = [&](homeward::NodeId a, homeward::NodeId b, double bearing) {
    homeward::Edge edge;
    edge.id = {edges++};
    edge.a = a;
    edge.b = b;
    edge.bearingAtA = bearing;
    edge.bearingAtB = homeward::wrapAngle(bearing + homeward::kPi);
    edge.length = kStep;
    update.changes.emplace_back(homeward::EdgeAdded{edge});
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      update.changes.emplace_back(homeward::NodeAdded{placeAt(column, row)});
      if (column > 0) {
        join(nodeAt(column, row), nodeAt(column - 1, row), homeward::kPi);
      }
      if (row > 0) {
        join(nodeAt(column, row), nodeAt(column, row - 1), -0.5 * homeward::kPi);
      }
    }
  }
  file.append(update);
  file.close();
  return 0;
}
