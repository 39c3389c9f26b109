// SPDX-License-Identifier: GPL-3.0-or-later
#include "../store/store_fixture.h"

#include <homeward/core/error.h>
#include <homeward/run/kept_exploration.h>

#include <gmock/gmock.h>

namespace homeward
{
namespace
{

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/** A state with every field other than a new one's. */
ExplorerState anyState()
{
  ExplorerState state;
  state.steps = 12;
  state.phase = ExplorerState::Phase::Following;
  state.origin = NodeId{3};
  state.direction = DirectionId{1};
  state.route = {NodeId{2}, NodeId{5}};
  state.target = NodeId{2};
  state.surely = true;
  state.strode = true;
  state.retreated = true;
  state.dissimilarity = 218.2;
  state.retries = 1;
  state.vain = {{NodeId{4}, 2}};
  state.refuted = {NodeId{6}};
  state.alike = {{NodeId{3}, NodeId{6}}};
  state.stranded = 1;
  state.failures = {{EdgeId{0}, 1}, {EdgeId{7}, 3}};
  state.attempts = {{{NodeId{3}, DirectionId{1}}, 1}};
  state.chord = {1.0 / 3.0, 2.0, -0.5, 3.0};
  return state;
}

std::string refusalOf(const std::string &text)
{
  try {
    parseExplorerState(text);
  }
  catch (const ConfigError &error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  ADD_FAILURE() << "taken: " << text;
  return "";
}

TEST(KeptExploration, IsReadAsItWasWritten)
{
  EXPECT_EQ(parseExplorerState(explorerStateJson(anyState())), anyState());
  EXPECT_EQ(parseExplorerState(explorerStateJson({})), ExplorerState{});
  for (int phase = 0; phase <= static_cast<int>(ExplorerState::Phase::Finished); ++phase) {
    ExplorerState state;
    state.phase = static_cast<ExplorerState::Phase>(phase);
    EXPECT_EQ(parseExplorerState(explorerStateJson(state)), state);
  }
}

TEST(KeptExploration, WhatAnOlderProgramDidNotWriteHasItsDefault)
{
  ExplorerState expected;
  expected.steps = 4;
  EXPECT_EQ(parseExplorerState(R"({"version": 1, "steps": 4})"), expected);
}

TEST(KeptExploration, WhatIsNotUnderstoodIsRefused)
{
  EXPECT_THAT(refusalOf(R"({"version": 2})"), HasSubstr("version 2, this program reads up to 1"));
  EXPECT_THAT(refusalOf(R"({"version": 1, "mood": 1})"), HasSubstr("unknown key mood"));
  EXPECT_THAT(refusalOf(R"({"version": 1, "phase": "asleep"})"), HasSubstr("'asleep' is no phase"));
  EXPECT_THAT(refusalOf(R"({"version": 1, "steps": 1.5})"), HasSubstr("1.5 is no whole number"));
  EXPECT_THAT(refusalOf(R"({"version": 1, "route": 3})"), HasSubstr("3 is no list"));
  EXPECT_THAT(refusalOf(R"({"version": 1, "vain": [[1]]})"), HasSubstr("[1] is no list of 2"));
  refusalOf("{}");
  refusalOf("[]");
  refusalOf("far away");
}

class KeptInAMap : public StoreTest
{};

TEST_F(KeptInAMap, AMapTellsWhatItKeepsAndWhereItIsWrong)
{
  auto file = MapFile::create(path(), smallHeader());
  file.append(nodeUpdate(0));
  EXPECT_FALSE(keptExploration(file));
  file.append({.values = {{kExplorationKey, explorerStateJson(anyState())}}});
  EXPECT_EQ(keptExploration(file), anyState());
  file.append({.values = {{kExplorationKey, "?"}}});
  try {
    keptExploration(file);
    ADD_FAILURE() << "taken";
  }
  catch (const StoreError &error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("test.hwm"), HasSubstr("cannot be read")));
  }
}

} // namespace
} // namespace homeward
