// Any lines through a trial pipe, beside a device that lies: only a whole right trial changes a
// wall, and the loop keeps the promises of tests/property/device_lies_property_test.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <chrono>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/session/experiment.h"
#include "app/session/trial_feed.h"
#include "tests/app/session/loop/lie_rig.h"
#include "tests/app/session/piped.h"
#include "tests/temporary_folder.h"

namespace hapticwall::session::test {
namespace {

using device::hid::Fault;
using device::hid::FaultKind;

constexpr std::uint64_t kRunMs = 1000;

// A line, and whether it is a right trial.
struct Line {
  std::string text;
  bool right = false;
};

Line random_line() {
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return {*rc::gen::arbitrary<std::string>()};
    case 1:
      return {std::string(*rc::gen::inRange<std::size_t>(0, 40'000), 'x')};
    case 2:
      return {R"({"trial":{"a":"","b":"wall.stiffness_n_per_m=-5"}})"};
    case 3:
      return {R"({"choose":1})"};
    default:
      return {"{\"trial\":{\"a\":\"wall.stiffness_n_per_m=" +
                  std::to_string(*rc::gen::inRange(0, 3000)) +
                  "\",\"b\":\"wall.stiffness_n_per_m=600; wall.position_m=0.0" +
                  std::to_string(*rc::gen::inRange(40, 60)) + "\"}}",
              true};
  }
}

Result<Scene> press_with(std::span<const std::string> overrides) {
  Result<file::LoadedScene> loaded = file::load_scene("press", overrides);
  if (!loaded) return loaded.error();
  return loaded->scene;
}

device::hid::FaultScript random_lies() {
  std::vector<Fault> faults(*rc::gen::inRange<std::size_t>(0, 4));
  for (Fault& fault : faults) {
    fault.kind = static_cast<FaultKind>(*rc::gen::inRange(
        static_cast<int>(FaultKind::kJump), static_cast<int>(device::hid::kFaultKinds)));
    fault.begin_us = *rc::gen::inRange<std::uint64_t>(300'000, 900'000);
    fault.duration_us = *rc::gen::inRange<std::uint64_t>(0, 200'000);
  }
  return device::hid::FaultScript(faults);
}

// Commands stay within the limit, and are zero while the device is off.
void check_force(LieRig& rig) {
  const Snapshot now = rig.snapshot();
  const bool off = now.arming.state == ArmingState::kOff;
  RC_ASSERT(std::abs(now.newest.x().force_n) <= device::hid::testing::kLimitN);
  // A wall over the handle: zero follows the command of this tick, which the sample has.
  if (off && now.arming.note != ArmingNote::kWallMoved) RC_ASSERT(now.newest.x().force_n == 0.0);
}

// Sends one line, waits until the feed has heard it, and puts the walls of a new trial in force.
void send_one(const hapticwall::session::test::Peer& peer, Experiment& experiment, LieRig& rig) {
  const Line line = random_line();
  const std::size_t before = experiment.trials.size();
  peer.write(line.text + "\n");
  experiment.feed->wait(std::chrono::milliseconds{line.right ? 10'000 : 2});
  const FeedEvent event = experiment.feed->take(experiment);
  if (line.right) RC_ASSERT(experiment.trials.size() <= before + 1);
  if (event != FeedEvent::kTrial) {
    RC_ASSERT(experiment.trials.size() == before);
    return;
  }
  RC_ASSERT(experiment.trials.size() == before + 1);
  for (const Scene& scene : experiment.scenes.back()) {
    RC_ASSERT(!validate(scene));
    rig.change_wall(scene.x().walls.front());
    for (int i = 0; i < 20; ++i) rig.tick();
  }
}

void run_script(const hapticwall::test::TemporaryFolder& folder) {
  std::filesystem::remove(folder.file("out.csv"));
  Peer peer;
  auto opened = open_experiment({kPiped, "P1", "1", folder.file("out.csv"), true}, press_with,
                                peer.program_end());
  RC_ASSERT(opened.ok());
  LieRig rig(random_lies(), *rc::gen::arbitrary<bool>());
  rig.on_tick = [&] { check_force(rig); };
  while (rig.now_us() < 1000 * kRunMs) {
    if (*rc::gen::inRange(0, 10) == 0) rig.arm();
    if (*rc::gen::inRange(0, 4) == 0) send_one(peer, **opened, rig);
    for (int i = 0; i < 20; ++i) rig.tick();
  }
}

TEST(TrialFeedProperty, NoLineChangesMoreThanTheWallsOfARightTrial) {
  const hapticwall::test::TemporaryFolder folder;
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  const auto result =
      rc::detail::checkTestable([&] { run_script(folder); }, rc::detail::TestMetadata(), params);
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  EXPECT_TRUE(result.is<rc::detail::SuccessResult>()) << text.str();
}

}  // namespace
}  // namespace hapticwall::session::test
