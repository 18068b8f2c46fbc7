// A recorded hand once more: under its own algorithm the recording comes out, bit for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "app/session/hand_rerun.h"
#include "core/algorithm/algorithm.h"
#include "core/run/batch_simulator.h"
#include "core/run/simulate.h"
#include "tests/app/session/replay_support.h"
#include "tests/app/session/session_support.h"

namespace hapticwall::session::test {
namespace {

using ::testing::HasSubstr;

class HandRerun : public ReplayTest {
 protected:
  [[nodiscard]] RerunOutcome rerun(const std::string& algorithm = "",
                                   const std::vector<std::string>& overrides = {},
                                   const RerunOptions& options = {}) {
    const auto reader = opened(path("a.csv"));
    const auto scene = rerun_scene(reader->info(), algorithm, overrides);
    if (!scene) throw std::runtime_error(scene.error().message);
    const auto outcome = rerun_hand(*reader, *scene, options);
    if (!outcome) throw std::runtime_error(outcome.error().message);
    return *outcome;
  }
  [[nodiscard]] std::string refusal(const std::string& algorithm,
                                    const std::vector<std::string>& overrides) {
    const auto scene = rerun_scene(opened(path("a.csv"))->info(), algorithm, overrides);
    if (scene) return "";
    EXPECT_EQ(scene.error().kind, ErrorKind::kUsage);
    return scene.error().message;
  }
  void expect_the_recording_again() {
    const RerunOutcome outcome = rerun();
    EXPECT_FALSE(outcome.first_different_tick) << *outcome.first_different_tick;
    EXPECT_EQ(outcome.largest_distance_m, 0.0);
    expect_a_study_to_run(outcome);
  }
  // Expects the same hand in a headless run, up to the recorded end.
  void expect_a_study_to_run(const RerunOutcome& rerun) {
    const auto reader = opened(path("a.csv"));
    const auto wanted = rerun_scene(reader->info(), "", {});
    ASSERT_TRUE(wanted);
    if (!wanted->changes.empty()) return;
    const auto scene = recorded_scene(*reader, *wanted);
    ASSERT_TRUE(scene);
    EXPECT_EQ(validate(*scene), std::nullopt);
    std::uint64_t row = 0;
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) {
      if (sample.tick < reader->info().scanned.first_tick) return;
      Tick recorded;
      ASSERT_EQ(*reader->read(row++, {&recorded, 1}), 1U);
      ASSERT_EQ(sample.truth.hand_path_m, recorded.x().truth.hand_path_m) << sample.tick;
      ASSERT_EQ(sample.truth.position_m, recorded.x().truth.position_m) << sample.tick;
      ASSERT_EQ(sample.truth.hand_work_j, recorded.x().truth.hand_work_j) << sample.tick;
      ASSERT_EQ(sample.energy_scv_j, recorded.x().energy_scv_j) << sample.tick;
    };
    const Summary summary = simulate(*scene, options).summary;
    EXPECT_EQ(row, reader->rows());
    EXPECT_EQ(summary.verdict, rerun.summary.verdict);
    EXPECT_EQ(summary.tail_peak_to_peak_m, rerun.summary.tail_peak_to_peak_m);
  }
  // hand_force_n too, which first_different_tick leaves out.
  [[nodiscard]] std::uint64_t other_hand_forces() {
    const auto reader = opened(path("a.csv"));
    std::uint64_t row = 0;
    std::uint64_t others = 0;
    RerunOptions options;
    options.on_sample = [&](const Sample& sample) {
      Tick recorded;
      EXPECT_EQ(*reader->read(row++, {&recorded, 1}), 1U);
      others += sample.truth.hand_force_n == recorded.x().truth.hand_force_n ? 0 : 1;
    };
    static_cast<void>(rerun("", {}, options));
    return others;
  }
};

Scene scene_of(const std::string& name) { return file::load_scene(name)->scene; }

// A pointer as a person moves it: seen sixty times a second, at rest, in a hurry, let go.
Pointer person(std::uint64_t seed, double middle_m, double range_m) {
  auto random = std::make_shared<std::mt19937_64>(seed);
  auto at_m = std::make_shared<std::optional<double>>();
  return [=](std::uint64_t tick) {
    constexpr std::uint64_t kFrame = 16;
    if (tick % kFrame == 0) {
      const std::uint64_t what = (*random)() % 8;
      const double share = static_cast<double>((*random)() % 10000) / 5000.0 - 1.0;
      if (what == 0) at_m->reset();
      if (what > 2) *at_m = middle_m + range_m * share;
      if (what == 7) *at_m = at_m->value() + 1.0;  // farther than it gets in a frame
    }
    return *at_m;
  };
}

TEST_F(HandRerun, AScriptedHandRepeatsItsRecording) {
  for (const char* name : {"press", "tap", "light", "golden-soft-fric"}) {
    SCOPED_TRACE(name);
    record(scene_of(name), 3000, {});
    expect_the_recording_again();
    EXPECT_EQ(other_hand_forces(), 0U);
    EXPECT_FALSE(rerun().pointer_led);
  }
}

TEST_F(HandRerun, AHandThatThePointerLedRepeatsItsRecording) {
  for (const char* name : {"press", "tap", "light"}) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(std::string(name) + std::to_string(seed));
      record(scene_of(name), 4000, person(seed, 0.05, 0.02));
      expect_the_recording_again();
      EXPECT_EQ(other_hand_forces(), 0U);
      EXPECT_TRUE(rerun().pointer_led);
    }
  }
}

TEST_F(HandRerun, SoItIsOnAWallAtZeroWhereDigitsAreFine) {
  Scene scene = scene_of("press");
  scene.x().device.start_m = -0.001;
  scene.x().device.encoder_m.reset();
  scene.x().hand->path = {
      {0.0, -0.001}, {0.7003, 0.0012}, {1.1, -0.0007}};  // bends between two ticks
  scene.x().walls.front().position_m = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    record(scene, 3000, person(seed, 0.0, 0.0015));
    expect_the_recording_again();
  }
}

TEST_F(HandRerun, SoItIsWithAHandThatOnlyThePointerLeads) {
  Scene scene = scene_of("press");
  scene.x().hand->path = {};
  scene.x().hand->follows_mouse = true;
  scene.sampling.rate_hz = 777.0;
  record(scene, 3000, person(3, 0.05, 0.02));
  expect_the_recording_again();
}

TEST_F(HandRerun, AHandWithoutAGripIsTheSameButForTheForceItWasAboutToHave) {
  Scene scene = scene_of("light");
  scene.x().hand->damping_n_s_per_m = 5.0;
  std::uint64_t others = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    record(scene, 4000, person(seed, 0.05, 0.02));
    expect_the_recording_again();
    others += other_hand_forces();
  }
  EXPECT_LT(others, 8U * 4000U / 50U);  // this person hardly lets the hand catch up
}

TEST_F(HandRerun, ChangesOfTheSessionAreItsOwn) {
  const Scene scene = scene_of("press");
  std::vector<ScheduledChange> changes{{500, scene}, {900, scene}, {900, scene}, {2000, scene}};
  changes[0].scene.x().walls.front().stiffness_n_per_m = 5000.0;
  changes[1].scene.x().device.mass_kg = 0.1;
  changes[2].scene.x().device.friction_n.reset();
  changes[3].scene.algorithm.index = find_algorithm("none").value();
  record(scene, 3000, person(5, 0.05, 0.02), changes);
  expect_the_recording_again();
}

TEST_F(HandRerun, ARecordingThatBeganLaterIsRepeatedFromItsFirstRow) {
  record(scene_of("press"), 3000, {}, {}, 1200);
  expect_the_recording_again();
  // Led, but only after it began.
  const Pointer later = person(2, 0.05, 0.02);
  record(
      scene_of("press"), 3000,
      [&](std::uint64_t tick) { return tick < 1500 ? std::nullopt : later(tick); }, {}, 1200);
  expect_the_recording_again();
}

TEST_F(HandRerun, ThePlantsStateBeforeTheRowsIsNotKnown) {
  record(
      scene_of("press"), 3000, [](std::uint64_t) { return 0.06; }, {}, 1200);
  const RerunOutcome outcome = rerun();
  EXPECT_EQ(outcome.first_different_tick, 1200U);
  EXPECT_TRUE(outcome.pointer_led);
  EXPECT_LT(outcome.largest_distance_m, 0.01);
  EXPECT_EQ(outcome.ticks, 3000U);
}

TEST_F(HandRerun, UnderAnotherAlgorithmItIsWhatASessionWouldHaveBeen) {
  const Pointer pointer = person(1, 0.055, 0.01);
  Scene scene = scene_of("press");
  record(scene, 3000, pointer);
  std::vector<Sample> samples;
  RerunOptions options;
  options.on_sample = [&](const Sample& sample) { samples.push_back(sample); };
  const RerunOutcome outcome = rerun("none", {}, options);
  EXPECT_EQ(outcome.summary.algorithm, "none");
  EXPECT_TRUE(outcome.first_different_tick);
  EXPECT_GT(outcome.largest_distance_m, 1e-4);
  // The session under that algorithm has the same pointer.
  scene.algorithm.index = find_algorithm("none").value();
  record(scene, 3000, person(1, 0.055, 0.01));
  const auto reader = opened(path("a.csv"));
  std::vector<Tick> session(3000);
  ASSERT_EQ(*reader->read(0, session), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(samples[i].truth.position_m, session[i].x().truth.position_m) << i;
    ASSERT_EQ(samples[i].energy_scv_j, session[i].x().energy_scv_j) << i;
  }
}

TEST_F(HandRerun, AStudyKeepsTheRateOfTheRows) {
  record(scene_of("press"), 300, person(1, 0.05, 0.02));
  const auto reader = opened(path("a.csv"));
  Scene scene = *recorded_scene(*reader, *rerun_scene(reader->info(), "", {}));
  EXPECT_EQ(scene.tick_count(), 300U);
  scene.sampling.rate_hz = 2000.0;
  EXPECT_EQ(validate(scene).value().key, "sampling.rate_hz");
  EXPECT_EQ(validate(scene).value().message,
            "the hand was recorded at 1000 Hz, and is re-run at no other rate");
}

TEST_F(HandRerun, ABatchFollowsTheRecordedHandToo) {
  Scene scene = scene_of("light");
  scene.sampling.rate_hz = 777.0;
  record(scene, 2500, person(4, 0.05, 0.02));
  const auto reader = opened(path("a.csv"));
  const Scene one = *recorded_scene(*reader, *rerun_scene(reader->info(), "", {}));
  std::vector<Scene> scenes(5, one);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scenes[i].x().walls.front().stiffness_n_per_m = 1000.0 * static_cast<double>(i + 1);
  }
  const std::vector<Summary> batch = simulate_all(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Summary alone = simulate(scenes[i]).summary;
    EXPECT_EQ(batch[i].tail_peak_to_peak_m, alone.tail_peak_to_peak_m) << i;
    EXPECT_EQ(batch[i].true_hand_work_j, alone.true_hand_work_j) << i;
  }
  EXPECT_NE(batch[0].true_hand_work_j, batch[4].true_hand_work_j);
}

TEST_F(HandRerun, OverridesAreTaken) {
  record(scene_of("press"), 1500, {});
  const RerunOutcome outcome = rerun("virtual-coupling", {"wall.stiffness_n_per_m=1000"});
  EXPECT_EQ(outcome.summary.algorithm, "virtual-coupling");
  EXPECT_GT(*outcome.summary.max_penetration_m, 0.002);
}

TEST_F(HandRerun, ItCanBeEnded) {
  record(scene_of("press"), 3000, {});
  RerunOptions options;
  options.keep_going = [](double fraction) { return fraction < 0.5; };
  const RerunOutcome outcome = rerun("none", {}, options);
  EXPECT_TRUE(outcome.stopped_early);
  EXPECT_EQ(outcome.ticks, 2048U);
}

TEST_F(HandRerun, ARunThatDivergesEndsThere) {
  Scene scene = scene_of("press");
  scene.simulator = {Integrator::kSemiImplicitEuler, 1};
  record(scene, 3000, {});
  const RerunOutcome outcome = rerun("none", {"hand.damping_n_s_per_m=10000"});
  EXPECT_EQ(outcome.summary.verdict, Verdict::kDiverged);
  EXPECT_EQ(outcome.summary.diverged_at_tick, outcome.ticks);
  EXPECT_LT(outcome.ticks, 3000U);
}

TEST_F(HandRerun, RefusesAnUnknownAlgorithmAndKeysThatAChangeSetsToo) {
  const Scene scene = scene_of("press");
  record(scene, 100, {}, {{10, scene}});
  EXPECT_THAT(refusal("nune", {}), HasSubstr("no algorithm is called 'nune'"));
  EXPECT_THAT(refusal("", {"wall.stiffness_n_per_m=1000"}), HasSubstr("parameters change 1 times"));
  EXPECT_EQ(refusal("none", {}), "");
}

TEST_F(HandRerun, AChangeOfAlgorithmHoldsThroughAllChanges) {
  const Scene scene = scene_of("press");
  ScheduledChange change{50, scene};
  change.scene.algorithm.index = find_algorithm("none").value();
  record(scene, 100, {}, {change});
  const auto wanted = rerun_scene(opened(path("a.csv"))->info(), "virtual-coupling", {});
  ASSERT_TRUE(wanted);
  const std::size_t index = find_algorithm("virtual-coupling").value();
  EXPECT_EQ(wanted->scene.algorithm.index, index);
  EXPECT_EQ(wanted->changes.at(0).scene.algorithm.index, index);
  EXPECT_EQ(wanted->scene.algorithm.values, scene.algorithm.values);
}

// The real thing: a thread, whatever its timing, and a pointer in between.
TEST_F(HandRerun, ALiveSessionsRecordingIsRepeated) {
  {
    const auto session = started_paused(contact_scene());
    ASSERT_FALSE(session->start_recording(path("a.csv")));
    session->pause(false);
    for (const double pointer_m : {0.06, 0.045, 0.058, 0.0512}) {
      session->move_hand(hand_to(pointer_m));
      const std::uint64_t ticks = session->snapshot().timing.ticks;
      ASSERT_TRUE(ticks_reach(*session, ticks + 150));
    }
    session->move_hand({.m = {-0.004}, .duration_s = 0.1});
    const std::uint64_t ticks = session->snapshot().timing.ticks;
    ASSERT_TRUE(ticks_reach(*session, ticks + 200));
    ASSERT_FALSE(session->stop_recording());
  }
  const auto reader = opened(path("a.csv"));
  ASSERT_GT(reader->rows(), 500U);
  const RerunOutcome outcome = rerun();
  EXPECT_TRUE(outcome.pointer_led);
  EXPECT_FALSE(outcome.first_different_tick) << *outcome.first_different_tick;
}

}  // namespace
}  // namespace hapticwall::session::test
