// Files of earlier versions, which are read as they were: recordings, maps, scenes, devices,
// trials. Each folder holds the files that the program of its version wrote.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/file/map/map_file.h"
#include "app/file/recording/recording_reader.h"
#include "app/file/scene/device_file.h"
#include "app/file/scene/scene_file.h"
#include "app/session/experiment.h"
#include "app/session/hand_rerun.h"
#include "core/algorithm/algorithm.h"
#include "core/scene_keys.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string old_file(const std::string& name) {
  return data_folder() + "/compatibility/0.1.0/" + name;
}

Scene scene_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  const Result<file::LoadedScene> loaded = file::load_scene(old_file(name), overrides);
  EXPECT_TRUE(loaded) << loaded.error().message;
  return loaded ? loaded->scene : Scene();
}

std::unique_ptr<file::RecordingReader> recording(const std::string& name) {
  auto opened = file::RecordingReader::open(old_file(name));
  EXPECT_TRUE(opened) << opened.error().message;
  return opened ? std::move(*opened) : nullptr;
}

Tick last_tick(file::RecordingReader& reader) {
  std::vector<Tick> ticks(1);
  const auto count = reader.read(reader.rows() - 1, ticks);
  EXPECT_TRUE(count && *count == 1);
  return ticks.front();
}

// nullopt without such a key.
std::optional<double> value_of(const Scene& scene, const std::string& path) {
  std::optional<double> value;
  visit_scene_numbers(scene, [&](const NumberPath& number, const auto& key, const auto& owner) {
    if (number == path) value = key.get(owner);
  });
  return value;
}

TEST(Version010, RecordingsAreReadWithoutANote) {
  for (const auto& [name, rows] : {std::pair("press-signals.csv", 300U),
                                   {"corner.csv", 200U},
                                   {"realtime.csv", 250U},
                                   {"then.csv", 200U}}) {
    const auto reader = recording(name);
    ASSERT_TRUE(reader) << name;
    const file::RecordingInfo& info = reader->info();
    EXPECT_EQ(reader->rows(), rows) << name;
    EXPECT_TRUE(info.has_sidecar) << name << info.sidecar_problem;
    EXPECT_THAT(info.notes, IsEmpty()) << name;
    EXPECT_TRUE(info.of_simulator()) << name;
    EXPECT_FALSE(info.loaded.edited) << name;
    EXPECT_EQ(info.rate_hz, 1000.0) << name;
  }
  EXPECT_EQ(recording("realtime.csv")->info().start_time, "2026-11-24T12:41:57Z");
}

TEST(Version010, ARecordingHasItsNumbersAndSignals) {
  const auto press = recording("press-signals.csv");
  const Sample last = last_tick(*press).x();
  EXPECT_EQ(last.tick, 299U);
  EXPECT_EQ(last.position_m, 0.050038);
  EXPECT_EQ(last.force_n, 1.249999999999873);
  EXPECT_EQ(last.truth.position_m, 0.04994125643934846);
  const auto signal = find_algorithm_signal("step_bound_n");
  ASSERT_TRUE(signal);
  EXPECT_EQ(last.signals.at(*signal), 0.01);
  EXPECT_EQ(algorithm_label(press->info().loaded.scene.algorithm), "energy-bounding");
  const auto corner = recording("corner.csv");
  EXPECT_EQ(last_tick(*corner).count, 2);
  EXPECT_EQ(last_tick(*corner).axes[1].position_m, 0.029972);
  EXPECT_EQ(algorithm_label(recording("then.csv")->info().loaded.scene.algorithm),
            "virtual-coupling then passivity-control");
}

// The last digits of the exact plant are those of a build, so rows of 0.1.0 have others.
TEST(Version010, ARunAgainOfARecordingKeepsItsPath) {
  constexpr double kLastDigitsM = 1e-14;
  for (const char* name : {"press-signals.csv", "realtime.csv", "then.csv"}) {
    const auto reader = recording(name);
    const auto scene = session::rerun_scene(reader->info(), "", {});
    ASSERT_TRUE(scene) << name << scene.error().message;
    const auto outcome = session::rerun_hand(*reader, *scene);
    ASSERT_TRUE(outcome) << name << outcome.error().message;
    EXPECT_LT(outcome->largest_distance_m, kLastDigitsM) << name;
    EXPECT_EQ(outcome->ticks, reader->rows()) << name;
  }
}

TEST(Version010, AMapIsRead) {
  StabilityMap map;
  map.scene = scene_of("map.toml");
  map.algorithms = {*find_algorithm("none"), *find_algorithm("energy-bounding")};
  map.x = {find_scene_number(map.scene, "wall.stiffness_n_per_m").value(), 100.0, 30e3, 3, true};
  map.y = {find_scene_number(map.scene, "wall.damping_n_s_per_m").value(), 0.0, 20.0, 2, false};
  EXPECT_TRUE(file::is_sidecar(old_file("map.toml"), file::kMapTable));
  const auto cells = file::read_map(old_file("map.csv"), map);
  ASSERT_TRUE(cells) << cells.error().message;
  ASSERT_EQ(cells->size(), 12U);
  EXPECT_EQ(cells->front().verdict, Verdict::kSettled);
  EXPECT_EQ(cells->back().verdict, Verdict::kOscillating);
  // The chart of normalised limits is no map.
  const auto chart = file::read_map(old_file("normalised.csv"), map);
  ASSERT_FALSE(chart);
  EXPECT_THAT(chart.error().message, HasSubstr("normalised.csv:1"));
}

TEST(Version010, ASceneMayHaveEveryKey) {
  const Scene scene = scene_of("every-key.toml");
  ASSERT_TRUE(scene.two_axes());
  ASSERT_TRUE(scene.axes[0].hand && scene.axes[1].hand);
  EXPECT_EQ(scene.axes[0].hand->path.file, std::filesystem::canonical(old_file("hand.csv")));
  EXPECT_EQ(scene.axes[0].hand->path.size(), 3U);
  EXPECT_EQ(scene.axes[1].walls.size(), 1U);
  EXPECT_EQ(scene.simulator.integrator, Integrator::kRungeKutta4);
  EXPECT_EQ(algorithm_label(scene.algorithm), "virtual-coupling then passivity-control");
  for (const auto& [key, value] : {std::pair("sampling.rate_hz", 2000.0),
                                   {"device.max_force_rate_n_per_s", 2500.0},
                                   {"device.amplifier_time_constant_s", 0.001},
                                   {"device.chai3d_stiffness_n_per_m", 5000.0},
                                   {"device.y.delay_ticks", 2.0},
                                   {"device.y.chai3d_damping_n_s_per_m", 10.0},
                                   {"hand.grip_stiffness_n_per_m", 1000.0},
                                   {"hand.y.grip_damping_n_s_per_m", 2.0},
                                   {"wall[1].stiffness_n_per_m", 1200.0},
                                   {"algorithm.coupling_stiffness_n_per_m", 3000.0},
                                   {"algorithm.velocity_floor_m_per_s", 0.001},
                                   {"algorithm.storage_stiffness_n_per_m", 900.0}})
    EXPECT_EQ(value_of(scene, key), value) << key;
}

TEST(Version010, ASceneMayNameItsDevice) {
  const Scene whole = scene_of("named-device.toml");
  EXPECT_TRUE(whole.x().hand && whole.x().hand->follows_mouse);
  EXPECT_EQ(value_of(whole, "device.mass_kg"), 0.0500171);
  EXPECT_EQ(value_of(whole, "device.friction_n"), 0.139953);
  const Scene part = scene_of("device-file.toml");
  EXPECT_EQ(value_of(part, "device.encoder_m"), 0.254e-3);
  EXPECT_EQ(value_of(part, "device.force_limit_n"), 4.0);
}

TEST(Version010, DeviceFilesAreRead) {
  const auto identified = file::load_device(old_file("identified.toml"));
  ASSERT_TRUE(identified) << identified.error().message;
  EXPECT_EQ(identified->x.damping_n_s_per_m, 1.00019);
  EXPECT_THAT(identified->identified, HasSubstr("2026-11-24T12:42:23Z"));
  const auto wheel = file::load_device(old_file("wheel.toml"));
  ASSERT_TRUE(wheel) << wheel.error().message;
  EXPECT_EQ(wheel->ff, (file::FfDescription{0.15, 540.0, 2.1, -1.0, 400.0, 0.003, "2026-01-31"}));
  EXPECT_EQ(wheel->x.max_speed_m_per_s, 3.0);
  const auto board = file::load_device(old_file("dialect.toml"));
  ASSERT_TRUE(board) << board.error().message;
  ASSERT_TRUE(board->dialect);
  EXPECT_EQ(board->dialect->usage_page, 0xff00);
  EXPECT_EQ(board->dialect->in.axes[1], (ReportField{12, FieldType::kU16, -1e-5, 0.0}));
  EXPECT_EQ(board->dialect->out.axes[0], (ReportField{4, FieldType::kI16, -0.002, 2000.0}));
  EXPECT_TRUE(board->dialect->reports_on_change);
  EXPECT_EQ(board->dialect->keep_alive_ms, 5);
  EXPECT_TRUE(board->chai3d);
}

// The participant may continue: list, scene and order are those of the answers.
TEST(Version010, AnExperimentContinuesItsAnswers) {
  const TemporaryFolder folder;
  const std::string answers = folder.file("answers.csv");
  std::filesystem::copy_file(old_file("answers-P01-1.csv"), answers);
  const session::ExperimentChoice choice{old_file("list.csv"), "P01", "1", answers, false};
  const auto experiment =
      session::open_experiment(choice, [](std::span<const std::string> overrides) -> Result<Scene> {
        Result<file::LoadedScene> loaded = file::load_scene("press", overrides);
        if (!loaded) return loaded.error();
        return loaded->scene;
      });
  ASSERT_TRUE(experiment) << experiment.error().message;
  EXPECT_EQ((*experiment)->trials.size(), 5U);
  const auto found = (*experiment)->answers.found();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].chosen, file::Slot::kA);
  EXPECT_EQ(found[0].correct, false);
  EXPECT_EQ(found[2].question, "Which is steadier?");
  EXPECT_EQ(found[2].correct, std::nullopt);
  EXPECT_EQ(found[3].first, file::Slot::kA);
  EXPECT_EQ(found[3].kind, file::TrialKind::kCatch);
}

}  // namespace
}  // namespace hapticwall::test
