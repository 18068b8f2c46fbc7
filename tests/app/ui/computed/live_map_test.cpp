#include "app/ui/computed/live_map.h"

#include <dirent.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>

#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/run/simulate.h"
#include "core/run/workers.h"
#include "tests/app/session/support.h"

namespace hapticwall::test {
namespace {

using ui::LiveMap;

// A short press: stiffness over damping under two algorithms.
StabilityMap plan(std::size_t values = 12) {
  StabilityMap map;
  map.scene = file::load_scene("press")->scene;
  map.scene.duration_s = 1.2;
  map.algorithms = {0, 3};
  map.x = {find_scene_number(map.scene, "wall.stiffness_n_per_m").value(), 1e3, 1e5, values, true};
  map.y = {find_scene_number(map.scene, "device.damping_n_s_per_m").value(), 0.5, 5.0, values,
           false};
  return map;
}

// Map so long that no test waits for its end.
StabilityMap endless() {
  StabilityMap map = plan(60);
  map.scene.duration_s = 1e4;
  return map;
}

void take_until(LiveMap& live, const std::function<bool()>& condition) {
  EXPECT_TRUE(session::test::eventually([&] {
    live.take();
    return condition();
  }));
}

std::set<int> threads_of_this_process() {
  std::set<int> threads;
  const std::unique_ptr<DIR, int (*)(DIR*)> tasks(opendir("/proc/self/task"), closedir);
  while (const dirent* entry = readdir(tasks.get())) {
    if (const auto id = file::parsed<int>(entry->d_name)) threads.insert(*id);
  }
  return threads;
}

bool yields_to_others(int thread) {
  return sched_getscheduler(thread) == SCHED_BATCH &&
         getpriority(PRIO_PROCESS, static_cast<id_t>(thread)) == 10;
}

TEST(MapStages, EveryCellHasAMiddleAndEveryMiddleIsItsOwn) {
  for (const std::size_t values : {2U, 11U, 12U, 60U}) {
    const StabilityMap map = plan(values);
    for (const std::size_t stage : ui::kMapStages) {
      for (std::size_t i = 0; i < values; ++i) {
        const std::size_t middle = ui::block_middle(i, stage, values);
        EXPECT_LT(middle, values);
        EXPECT_EQ(ui::block_middle(middle, stage, values), middle);
      }
      const std::size_t blocks = (values + stage - 1) / stage;
      EXPECT_EQ(ui::middles(map, stage).size(), 2 * blocks * blocks);
    }
  }
}

TEST(MapPicture, ShowsTheMiddleInItsWholeBlockAndNowhereElse) {
  const StabilityMap map = plan();
  ui::MapPicture picture(map);
  const std::size_t middle = ui::middles(map, 3).back();
  MapMetrics metrics;
  metrics.verdict = Verdict::kDiverged;
  picture.add(middle, 3, metrics);
  std::size_t shown = 0;
  for (std::size_t cell = 0; cell < map.cell_count(); ++cell) {
    if (picture.figures()[cell] == metrics) ++shown;
    if (picture.figures()[cell] == metrics) EXPECT_EQ(picture.source(cell), middle);
  }
  EXPECT_EQ(shown, 9U);
  EXPECT_EQ(picture.figures().back(), metrics);
}

TEST(LiveMapTest, FirstIsCoarseAndWholeAndAtTheEndEveryCellHasTheBitsOfASimulation) {
  LiveMap live;
  const StabilityMap map = plan();
  live.ask_for(map);
  EXPECT_FALSE(live.up_to_date());
  take_until(live, [&] { return live.up_to_date(); });
  for (std::size_t cell = 0; cell < map.cell_count(); ++cell) {
    EXPECT_EQ(live.picture()->figures()[cell],
              map_metrics(simulate(map.scene_at(live.picture()->source(cell))).summary));
  }
  take_until(live, [&] { return live.complete(); });
  EXPECT_FALSE(live.running());
  EXPECT_EQ(live.fraction(), 1.0);
  for (std::size_t cell = 0; cell < map.cell_count(); ++cell) {
    EXPECT_EQ(live.picture()->source(cell), cell);
    EXPECT_EQ(live.picture()->figures()[cell], map_metrics(simulate(map.scene_at(cell)).summary))
        << cell;
  }
}

TEST(LiveMapTest, HasTheBoundsOfTheFigure) {
  LiveMap live;
  live.ask_for(plan());
  take_until(live, [&] { return live.up_to_date(); });
  const auto wanted = draw::map_bounds(plan());
  ASSERT_EQ(live.picture()->bounds.size(), wanted.size());
  ASSERT_FALSE(wanted.empty());
  EXPECT_EQ(live.picture()->bounds.front().lines, wanted.front().lines);
}

TEST(LiveMapTest, TheSameMapIsNotComputedTwice) {
  LiveMap live;
  live.ask_for(plan());
  take_until(live, [&] { return live.complete(); });
  StabilityMap same = plan();
  same.scene.x().walls.front().stiffness_n_per_m *= 2.0;  // a number of its axes
  live.ask_for(same);
  EXPECT_TRUE(live.complete());
  EXPECT_FALSE(live.running());
}

TEST(LiveMapTest, AnotherMapRestartsItAndThePictureStaysUntilTheNextIsThere) {
  LiveMap live;
  live.ask_for(plan());
  take_until(live, [&] { return live.complete(); });
  live.ask_for(endless());
  EXPECT_TRUE(live.running());
  EXPECT_FALSE(live.complete());
  EXPECT_FALSE(live.up_to_date());
  ASSERT_NE(live.picture(), nullptr);
  EXPECT_EQ(live.picture()->map().x.count, plan().x.count);
  live.ask_for(plan(9));
  take_until(live, [&] { return live.complete(); });
  EXPECT_EQ(live.picture()->map().x.count, 9U);
}

TEST(LiveMapTest, AStopLeavesNoThreadAndTheNextQuestionBeginsAgain) {
  const std::set<int> before = threads_of_this_process();
  LiveMap live;
  live.ask_for(endless());
  EXPECT_TRUE(session::test::eventually([&] { return threads_of_this_process() != before; }));
  live.stop();
  EXPECT_FALSE(live.running());
  EXPECT_TRUE(session::test::eventually([&] { return threads_of_this_process() == before; }));
  live.ask_for(endless());
  EXPECT_TRUE(live.running());
}

TEST(LiveMapTest, LeavesACoreToTheLoopAndYieldsOnTheOthers) {
  const std::set<int> before = threads_of_this_process();
  StabilityMap map = plan(60);
  map.scene.duration_s = 20.0;
  LiveMap live;
  live.ask_for(map);
  std::size_t most = 0;
  bool yield = false;
  take_until(live, [&] {
    std::vector<int> started;
    std::ranges::set_difference(threads_of_this_process(), before, std::back_inserter(started));
    most = std::max(most, started.size());
    yield = yield || (!started.empty() && std::ranges::all_of(started, yields_to_others));
    return live.up_to_date();
  });
  EXPECT_TRUE(yield);
  EXPECT_GE(most, 1U);
  EXPECT_LE(most, std::max(worker_count(0), std::size_t{2}) - 1);
}

TEST(LiveMapTest, ItsEndWaitsForItsThreads) {
  const std::set<int> before = threads_of_this_process();
  {
    LiveMap live;
    live.ask_for(endless());
  }
  EXPECT_EQ(threads_of_this_process(), before);
}

TEST(LiveMapTest, AnInvalidMapIsExplainedOnceAndNotComputed) {
  StabilityMap map = plan();
  map.y.low = -1.0;
  LiveMap live;
  live.ask_for(map);
  EXPECT_NE(live.problem().find("damping"), std::string::npos) << live.problem();
  EXPECT_FALSE(live.running());
  live.ask_for(map);
  EXPECT_FALSE(live.running());
  live.ask_for(plan());
  EXPECT_EQ(live.problem(), "");
  EXPECT_TRUE(live.running());
}

}  // namespace
}  // namespace hapticwall::test
