// SPDX-License-Identifier: GPL-3.0-or-later
#include "../store/store_fixture.h"
#include "grid_world.h"
#include "killing_vfs.h"

#include <homeward/core/random.h>
#include <homeward/run/run_mission.h>
#include <homeward/store/export.h>

#include <gmock/gmock.h>
#include <sys/wait.h>

namespace homeward
{
namespace
{

/** A grid world as a pilot, with a clock that goes on a second a command; copied, it is kept. */
class GridPilot final : public Clock
{
public:
  explicit GridPilot(const GridWorld &world) : m_world(world) {}

  Time now() const override { return m_now; }
  void sleepUntil(Time instant) override { m_now = std::max(m_now, instant); }

  Report execute(const Command &command)
  {
    m_now = m_now + fromSeconds(1.0);
    Report report = m_world.execute(command);
    m_view = smallPanorama(10 * m_world.robot().first + m_world.robot().second);
    return report;
  }

  const Panorama &view() const { return m_view; }

  void remember(NodeId node, const Panorama & /*panorama*/)
  {
    if (node.value == static_cast<std::int64_t>(m_world.nodes.size())) {
      m_world.follow({NodeAdded{{node}}});
    }
  }

private:
  GridWorld m_world;
  Time m_now{};
  Panorama m_view = smallPanorama(0);
};

/** What came of an exploration. */
struct Explored
{
  std::string map; ///< canonical
  std::vector<LogLine> log;
};

void expectSame(const Explored &again, const Explored &whole)
{
  EXPECT_EQ(again.map, whole.map);
  EXPECT_EQ(again.log, whole.log);
}

class KilledExploration : public StoreTest
{
protected:
  /** A ring of eight places round a table with a dead end; the first homings fail. */
  static GridWorld world()
  {
    GridWorld world({"....", ".#.#", "...#"}, {0, 0});
    world.homingFailures = 3;
    return world;
  }

  /**
   * Explores to the end, or goes on exactly where the map file has it.
   * @param pilots by step: how they were when it was in the file; grows
   */
  Explored explore(std::map<int, GridPilot> &pilots) const
  {
    const Explorer explorer({.forwardDistance = 1.0});
    MapFile file = std::filesystem::exists(path()) ? MapFile::open(path())
                                                   : MapFile::create(path(), smallHeader());
    const std::optional<ExplorerState> kept = keptExploration(file);
    GridPilot pilot = kept ? pilots.at(kept->steps) : GridPilot(world());
    rememberAll(file, pilot);
    const Step<ExplorerState> first =
        kept ? Step<ExplorerState>{*kept, explorer.pending(*kept, file.map()), {}, {}}
             : explorer.start(file.map());
    MissionCounts counts;
    runMission(
        explorer, first, pilot, file.map(), &file, pilot, counts, [] { return false; },
        [&](const auto &step) { pilots.emplace(step.state.steps, pilot); });
    Explored explored{exportCanonical(file), file.log()};
    file.close();
    return explored;
  }

  /** Explores in a process that is killed at its n-th write. Whether it was. */
  bool exploreAndDie(int call, KillingVfs::Last last, std::map<int, GridPilot> pilots) const
  {
    const pid_t child = fork();
    if (child == 0) {
      try {
        KillingVfs::dieAt(call, last);
        explore(pilots);
        _exit(0);
      }
      catch (const std::exception &error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(1);
      }
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) ? WTERMSIG(status) == SIGKILL : WEXITSTATUS(status) == 0);
    return WIFSIGNALED(status);
  }

  /** A map that has its name is sound, however it was left. */
  void check() const
  {
    if (std::filesystem::exists(path())) {
      const MapFile file = MapFile::open(path(), MapFile::Access::Read);
      EXPECT_FALSE(file.map().nodes().empty());
      EXPECT_TRUE(keptExploration(file));
      for (const auto &[id, node] : file.map().nodes()) {
        EXPECT_NO_THROW(file.panorama(id));
      }
    }
  }

  void clear() const
  {
    for (const std::string &name : files()) {
      std::filesystem::remove(folder() / name);
    }
  }

  /** Kills at every write; the number of writes. */
  int killAtEveryWrite(KillingVfs::Last last) const
  {
    std::map<int, GridPilot> pilots;
    const Explored whole = explore(pilots);
    EXPECT_THAT(whole.map, testing::HasSubstr("node 8"));
    int writes = 0;
    clear();
    while (exploreAndDie(writes + 1, last, pilots) && !HasFailure()) {
      ++writes;
      check();
      SCOPED_TRACE("killed at write " + std::to_string(writes));
      expectSame(explore(pilots), whole);
      EXPECT_THAT(files(), testing::ElementsAre("test.hwm"));
      clear();
    }
    return writes;
  }

private:
  KillingVfs m_vfs;
};

TEST_F(KilledExploration, ResumesExactlyFromEveryWrite)
{
  const int writes = killAtEveryWrite(KillingVfs::Last::Nothing);
  RecordProperty("writes", writes);
  EXPECT_GT(writes, 100);
}

TEST_F(KilledExploration, ResumesExactlyFromEveryWriteThatIsTornInTheMiddle)
{
  EXPECT_GT(killAtEveryWrite(KillingVfs::Last::HalfAWrite), 100);
}

TEST_F(KilledExploration, IsKilledAgainAndAgain)
{
  std::map<int, GridPilot> pilots;
  const Explored whole = explore(pilots);
  Random random(1, 0);
  for (int run = 0; run < 8; ++run) {
    clear();
    int kills = 0;
    while (exploreAndDie(static_cast<int>(random.uniform(1.0, 80.0)), KillingVfs::Last::HalfAWrite,
                         pilots)) {
      ASSERT_LT(++kills, 500);
      check();
    }
    expectSame(explore(pilots), whole);
  }
}

} // namespace
} // namespace homeward
