// hapticwall identify on the simulator: numbers, device file, figure, a scene that names it,
// Ctrl-C.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "app/file/scene/device_file.h"
#include "app/file/scene/scene_file.h"
#include "app/table/identify_report.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class IdentifyTest : public ProgramTest {
 protected:
  // A device that differs from that of `tap` in every number.
  [[nodiscard]] Answer identify(std::vector<std::string> more,
                                const std::string& seconds = "9") const {
    std::vector<std::string> arguments{"identify",
                                       "--seconds",
                                       seconds,
                                       "--set",
                                       "device.mass_kg=0.12",
                                       "--set",
                                       "device.damping_n_s_per_m=1.7",
                                       "--set",
                                       "device.friction_n=0.2",
                                       "--set",
                                       "device.delay_ticks=2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hapticwall(std::move(arguments));
  }
};

TEST_F(IdentifyTest, FindsTheSimulatedDevice) {
  const Answer answer = identify({"--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("let go of the handle"));
  const nlohmann::json found = nlohmann::json::parse(answer.out);
  EXPECT_TRUE(found["fits"]);
  EXPECT_NEAR(found["mass_kg"]["value"], 0.12, 0.002);
  EXPECT_NEAR(found["damping_n_s_per_m"]["value"], 1.7, 0.05);
  EXPECT_NEAR(found["friction_n"]["value"], 0.2, 0.005);
  EXPECT_NEAR(found["delay_s"]["value"], 2e-3, 0.3e-3);
  EXPECT_LE(found["mass_kg"]["low"], found["mass_kg"]["value"]);
  EXPECT_EQ(found["force_limit_n"], 0.2 * 8.9) << "of the device's";
  EXPECT_THAT(found["date"].get<std::string>(), EndsWith("Z"));
}

// The intervals contain no error of the device's force.
TEST(Identified, TextJsonAndDeviceFileNameTheForceScaleBesideTheIntervals) {
  identify::Identification found;
  found.fits = true;
  const table::IdentifiedBy by{"paddle", "2026-01-31T10:00:00Z"};
  const std::string note = "An error of the device's force scale goes unseen into m, b and f_c.";
  EXPECT_THAT(table::identify_text(by, found), HasSubstr("\n" + note + "\n"));
  EXPECT_EQ(nlohmann::json::parse(table::identify_json(by, found))["note"], note);
  EXPECT_THAT(table::identified_line(by, found),
              HasSubstr("95 % intervals if the force scale is right: m "));
  found.fits = false;
  EXPECT_THAT(table::identify_text(by, found), Not(HasSubstr(note))) << "without numbers";
  EXPECT_TRUE(nlohmann::json::parse(table::identify_json(by, found))["note"].is_null());
}

TEST_F(IdentifyTest, TheDeviceFileMakesTheDeviceOfAScene) {
  ASSERT_EQ(
      identify({"--device-file", "mine.toml", "--quiet", "--set", "sampling.rate_hz=2000"}).status,
      0);
  const auto device = file::parse_device(content("mine.toml"), "mine.toml");
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_NEAR(*device->x.mass_kg, 0.12, 0.002);
  EXPECT_THAT(device->identified, HasSubstr("95 % intervals"));
  EXPECT_NEAR(device->x.friction_n.value_or(0.0), 0.2, 0.005);
  EXPECT_EQ(device->rate_hz, 2000.0);

  const Answer run = hapticwall(
      {"run", "press", "--set", "device=mine", "--duration", "0.2", "--csv", "a.csv", "--quiet"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto loaded = file::parse_scene(content("a.toml"), "a.toml");
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->scene.x().device.mass_kg, *device->x.mass_kg);
  EXPECT_EQ(loaded->scene.x().device.damping_n_s_per_m, *device->x.damping_n_s_per_m);
  EXPECT_THAT(loaded->scene.description,
              EndsWith("device " + device->name + ": " + device->identified));
}

TEST(IdentifiedDevice, AWheelGetsItsDelayWithTheDate) {
  identify::Identification found;
  found.mass_kg = {0.1, 0.1, 0.1};
  found.delay_s = {0.0023, 0.002, 0.0026};
  file::DeviceDescription wheel = *file::load_device("force-feedback-wheel");
  wheel = table::identified_device(wheel, {"wheel", "2026-01-31T10:00:00Z"}, found);
  EXPECT_NEAR(wheel.ff->delay_s, 0.0023, 1e-6);
  EXPECT_EQ(wheel.ff->delay_date, "2026-01-31");
  EXPECT_EQ(file::parse_device(file::device_to_toml(wheel), "wheel.toml")->ff, wheel.ff);
}

TEST_F(IdentifyTest, TheAlgorithmOfASceneUsesTheDampingOfItsDevice) {
  put("mine.toml",
      "source = \"s\"\n[x]\nencoder_m = 3e-5\nforce_limit_n = 6\nmass_kg = 0.09\n"
      "damping_n_s_per_m = 0.4\nfriction_n = 0.1\n");
  const auto rows = [&](const std::string& name, const std::vector<std::string>& settings) {
    std::vector<std::string> arguments{"run",   "press", "--algorithm", "energy-bounding",
                                       "--csv", name,    "--quiet"};
    for (const std::string& setting : settings) {
      arguments.insert(arguments.end(), {"--set", setting});
    }
    const Answer answer = hapticwall(std::move(arguments));
    EXPECT_EQ(answer.status, 0) << answer.err;
    return content(name);
  };
  const std::string named = rows("named.csv", {"device=mine"});
  EXPECT_EQ(named, rows("same.csv",
                        {"device.encoder_m=3e-5", "device.force_limit_n=6", "device.mass_kg=0.09",
                         "device.damping_n_s_per_m=0.4", "device.friction_n=0.1"}));
  EXPECT_NE(named, rows("other.csv", {"device=mine", "device.damping_n_s_per_m=0.5"}));
}

TEST_F(IdentifyTest, TheExperimentObeysLimitTravelSecondsAndRate) {
  const auto found = [&](std::vector<std::string> more, const std::string& seconds = "9") {
    more.insert(more.end(), {"--json", "-", "--quiet"});
    const Answer answer = identify(std::move(more), seconds);
    EXPECT_EQ(answer.status, 0) << answer.err;
    return nlohmann::json::parse(answer.out);
  };
  const nlohmann::json usual = found({});
  const int turns = usual["turns"];
  EXPECT_GT(found({"--travel", "0.008"})["turns"], turns * 5 / 4);
  EXPECT_GT(found({}, "18")["turns"], turns * 3 / 2);
  EXPECT_NE(found({"--set", "device.max_force_rate_n_per_s=20"})["mass_kg"], usual["mass_kg"]);
  EXPECT_THAT(identify({"--limit", "0.15"}).err, HasSubstr("the handle did not move"));
}

TEST_F(IdentifyTest, WithoutALimitAStrongDeviceGetsTwoNewtons) {
  const Answer answer = identify({"--set", "device.force_limit_n=30", "--json", "-", "--quiet"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(nlohmann::json::parse(answer.out)["force_limit_n"], 2.0);
}

// Forces in steps of 0.1 N are not those of the model.
TEST_F(IdentifyTest, AModelThatDoesNotFitGivesNoNumberAndNoDeviceFile) {
  const Answer answer = identify({"--set", "device.force_resolution_n=0.1", "--json", "-",
                                  "--device-file", "a.toml", "--quiet"});
  EXPECT_EQ(answer.status, 3);
  EXPECT_THAT(answer.err, HasSubstr("this model does not fit"));
  EXPECT_EQ(answer.error_lines(), 1);
  const nlohmann::json found = nlohmann::json::parse(answer.out);
  EXPECT_FALSE(found["fits"]);
  for (const char* number : {"mass_kg", "damping_n_s_per_m", "friction_n", "delay_s"}) {
    EXPECT_TRUE(found[number].is_null()) << number;
  }
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(IdentifyTest, DrawsAFigure) {
  ASSERT_EQ(identify({"--plot", "a.png", "--quiet"}).status, 0);
  EXPECT_GT(size("a.png"), 10'000U);
}

TEST_F(IdentifyTest, ADeviceThatCannotMoveIsOneSentence) {
  const Answer answer =
      identify({"--set", "device.friction_n=5", "--device-file", "a.toml", "--quiet"});
  EXPECT_EQ(answer.status, 3);
  EXPECT_THAT(answer.err, HasSubstr("the handle did not move"));
  EXPECT_EQ(answer.error_lines(), 1);
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(IdentifyTest, ALimitBeyondTheDeviceIsRefused) {
  const Answer answer = identify({"--limit", "20", "--quiet"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.err, HasSubstr("the device gives at most"));
}

// An experiment of 300 s and its fit take much longer than the signal.
TEST_F(IdentifyTest, CtrlCEndsItAndLeavesNoFile) {
  const pid_t child = start({program(), "identify", "--seconds", "300", "--device-file", "a.toml"});
  wait_until_written(child, "stderr");
  kill(child, SIGINT);
  const Answer answer = wait_for(child);
  EXPECT_EQ(answer.status, 130) << answer.err;
  EXPECT_THAT(answer.err, HasSubstr("ended early by Ctrl-C"));
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace hapticwall::command::test
