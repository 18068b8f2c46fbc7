// The page Identify on the simulator and on a device that moves, in fast time: let go, experiment,
// fit, file; and whatever ends it, with the force off.
#include <gmock/gmock.h>

#include <atomic>
#include <limits>
#include <thread>

#include "app/file/scene/device_file.h"
#include "app/session/loop_session.h"
#include "device/simulated_device.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Some thousand times as fast as the clock of the machine at most, so that the frames keep up.
class RestingClock final : public session::Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override { return now_ns_; }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    if (++sleeps_ % 40 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    now_ns_ = std::max(now_ns_, deadline_ns);
  }

 private:
  std::int64_t now_ns_ = 0;
  std::uint32_t sleeps_ = 0;
};

enum class Lie : std::uint8_t { kNone, kJump, kNan, kFrozen, kGone };

// State of the device that the test and the loop's thread share.
struct Moved {
  std::atomic<Lie> lie{Lie::kNone};
  std::atomic<double> newest_n{0.0};
  std::atomic<std::uint64_t> pushes{0};
  std::atomic<bool> enabled{false};
  std::atomic<bool> pushed_disabled{false};
  std::atomic<int> open{0};
};

// A real device, as the loop sees it: it moves as the simulator does, and lies when told to.
class MovingDevice final : public device::Device {
 public:
  MovingDevice(const Scene& scene, Moved& moved) : plant_(scene), moved_(moved) {}
  [[nodiscard]] device::DeviceInfo info() const override {
    return {"paddle", false, 0.254e-3, 8.9};
  }
  [[nodiscard]] Failure open() override {
    EXPECT_EQ(moved_.open++, 0) << "two loops hold the device";
    return std::nullopt;
  }
  [[nodiscard]] DeviceReading read() override {
    DeviceReading reading = plant_.read();
    if (moved_.lie == Lie::kNone) frozen_m_ = reading.position_m;
    if (moved_.lie == Lie::kJump) reading.position_m += 0.05;
    if (moved_.lie == Lie::kNan) reading.position_m = std::numeric_limits<double>::quiet_NaN();
    if (moved_.lie == Lie::kFrozen) reading.position_m = frozen_m_;
    if (moved_.lie == Lie::kGone) reading.state = DeviceState::kFault;
    return reading;
  }
  void enable(bool enabled) override { moved_.enabled = enabled; }
  void write(double force_n) override {
    moved_.newest_n = force_n;
    if (force_n != 0.0) ++moved_.pushes;
    if (force_n != 0.0 && !moved_.enabled) moved_.pushed_disabled = true;
    plant_.write(moved_.enabled ? force_n : 0.0);
  }
  void close() override {
    EXPECT_EQ(moved_.newest_n, 0.0);
    --moved_.open;
  }

 private:
  device::SimulatedDevice plant_;
  Moved& moved_;
  double frozen_m_ = 0.0;
};

class IdentifyPageTest : public GuiTest {
 protected:
  void SetUp() override {
    start_experiment = [this](const Scene& scene, BorrowedAlgorithm* borrowed) {
      session::SessionOptions session;
      session.clock = &clock_;
      session.allow_no_realtime = true;
      std::unique_ptr<device::Device> device;
      if (with_device) device = std::make_unique<MovingDevice>(scene, moved_);
      return session::start_under(borrowed, std::move(device), scene, session);
    };
    GuiTest::SetUp();
    show();
  }
  void show() {
    options.recording_folder = folder_.path().string();
    state().recording.folder = folder_.path().string();
    ui::show_page(state().dock, "Identify");
    frames(6);
    identify().choice.seconds = 8.0;
  }
  void open_on_device() {
    with_device = true;
    application_.reset();
    moved_.pushes = 0;
    open("press");
    show();
  }
  [[nodiscard]] ui::IdentifyState& identify() const { return state().identify; }
  [[nodiscard]] bool runs() const { return identify().experiment != nullptr; }
  void start() {
    click("identify start");
    ASSERT_TRUE(runs()) << identify().problem << message().text;
  }
  // Starts on the device, arms it, and waits until it moves.
  void start_and_arm() {
    open_on_device();
    start();
    EXPECT_EQ(moved_.pushes, 0U);
    press(ImGuiKey_A);
    frames_until([&] {
      return !runs() || identify().experiment->progress().stage == session::IdentifyStage::kStrokes;
    });
    ASSERT_TRUE(runs()) << identify().problem;
    EXPECT_GT(moved_.pushes, 0U);
  }
  void expect_over_without_force(const std::string& why) {
    EXPECT_FALSE(runs());
    EXPECT_FALSE(identify().result);
    EXPECT_FALSE(identify().fit.running());
    EXPECT_THAT(identify().problem, HasSubstr(why));
    EXPECT_THAT(identify().problem, StartsWith("the experiment ended with the force off: "));
    EXPECT_EQ(moved_.newest_n, 0.0);
    EXPECT_FALSE(moved_.enabled);
    EXPECT_FALSE(moved_.pushed_disabled);
    EXPECT_EQ(moved_.open, 0) << "its session is over";
    EXPECT_EQ(devices_open, with_device ? 1 : 0) << "and that of before is back";
    EXPECT_FALSE(sees("identify save"));
    EXPECT_TRUE(files().empty());
  }

  RestingClock clock_;
  Moved moved_;
};

TEST(FigureCurve, ThinnedKeepsTheExtremes) {
  draw::FigureCurve curve;
  for (int i = 0; i < 1001; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 500 ? 7.0 : i == 501 ? -7.0 : i % 3);
  }
  EXPECT_EQ(thinned(curve, 600).y, curve.y);
  const draw::FigureCurve thin = thinned(curve, 10);
  EXPECT_LE(thin.x.size(), 20U);
  EXPECT_EQ(*std::max_element(thin.y.begin(), thin.y.end()), 7.0);
  EXPECT_EQ(*std::min_element(thin.y.begin(), thin.y.end()), -7.0);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

TEST_F(IdentifyPageTest, FindsTheSimulatedDeviceAndSavesIt) {
  const Scene before = scene();
  state().scene.repeats = true;
  const std::size_t steps = state().scene.undo.size();
  start();
  EXPECT_TRUE(application_->live()->scene().x().walls.empty());
  EXPECT_FALSE(sees("identify start"));
  frames_until([&] { return !runs(); });
  EXPECT_EQ(scene(), before);
  EXPECT_EQ(application_->live(), fake_);
  EXPECT_TRUE(state().scene.repeats);
  EXPECT_EQ(state().scene.undo.size(), steps);
  frames_until([&] { return !identify().fit.running(); });
  frames(2);
  ASSERT_TRUE(identify().result) << identify().problem;
  const auto& found = identify().result->found;
  ASSERT_TRUE(found.fits) << found.residual_ratio;
  EXPECT_NEAR(found.mass_kg.value, before.x().device.mass_kg, 0.02 * before.x().device.mass_kg);
  EXPECT_THAT(text(), HasSubstr("moving mass m"));

  type("identify name", "my paddle.toml");
  click("identify save");
  EXPECT_THAT(message().text, HasSubstr("my-paddle.toml: written"));
  const auto device = file::load_device(path("my-paddle.toml"));
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_NEAR(*device->x.mass_kg, found.mass_kg.value, 1e-5 * found.mass_kg.value);
  EXPECT_EQ(device->source, "hapticwall identify --device sim");
  click("identify save");
  EXPECT_THAT(message().text, HasSubstr("my-paddle-2.toml"));
}

TEST_F(IdentifyPageTest, TheDeviceIsMovedOnlyOnceItIsArmed) {
  open_on_device();
  start();
  EXPECT_THAT(text(), HasSubstr("let go of the handle"));
  frames(60);
  EXPECT_TRUE(runs());
  EXPECT_EQ(moved_.pushes, 0U);
  EXPECT_FALSE(moved_.enabled);
  press(ImGuiKey_A);
  frames_until([&] { return !runs(); });
  EXPECT_GT(moved_.pushes, 0U);
  EXPECT_EQ(moved_.newest_n, 0.0);
  EXPECT_FALSE(moved_.enabled);
  EXPECT_EQ(moved_.open, 0);
  frames_until([&] { return !identify().fit.running(); });
  frames(1);
  ASSERT_TRUE(identify().result) << identify().problem;
  EXPECT_EQ(identify().result->by.device, "paddle");
}

TEST_F(IdentifyPageTest, TheButtonAndSpaceEndIt) {
  start_and_arm();
  click("identify end");
  expect_over_without_force("switched off");
  start();
  press(ImGuiKey_A);
  frames_until([&] { return moved_.enabled.load(); });
  press(ImGuiKey_Space);
  expect_over_without_force("switched off");
}

TEST_F(IdentifyPageTest, LeavingThePageEndsIt) {
  start_and_arm();
  ui::show_page(state().dock, ui::kPlotsPage);
  frames(8);
  ui::show_page(state().dock, "Identify");
  frames(8);
  expect_over_without_force("its page was left");
}

TEST_F(IdentifyPageTest, AnotherSceneEndsItAndBegins) {
  start_and_arm();
  state().scene.wanted = ui::WantedScene{file::load_scene("tap")->scene, true};
  frames(3);
  expect_over_without_force("the scene was changed");
  EXPECT_EQ(scene().name, "tap");
}

TEST_F(IdentifyPageTest, AChangeOfItsSceneEndsIt) {
  start_and_arm();
  Scene changed = application_->live()->scene();
  changed.x().device.mass_kg *= 2.0;
  EXPECT_FALSE(application_->live()->change_scene(changed));
  frames(3);
  expect_over_without_force("the scene was changed");
  EXPECT_EQ(scene().name, "press");
}

TEST_F(IdentifyPageTest, ALieEndsItWithoutAFile) {
  for (const Lie lie : {Lie::kJump, Lie::kNan, Lie::kFrozen, Lie::kGone}) {
    SCOPED_TRACE(static_cast<int>(lie));
    moved_.lie = Lie::kNone;
    start_and_arm();
    moved_.lie = lie;
    frames_until([&] { return !runs(); });
    frames(2);
    expect_over_without_force("");
  }
}

TEST_F(IdentifyPageTest, TheEndOfTheWindowEndsIt) {
  start_and_arm();
  application_.reset();
  EXPECT_EQ(moved_.newest_n, 0.0);
  EXPECT_FALSE(moved_.enabled);
  EXPECT_EQ(moved_.open, 0);
}

TEST_F(IdentifyPageTest, ADeviceThatDoesNotComeBackIsNoExperiment) {
  open_on_device();
  start_experiment = [this](const Scene& scene, BorrowedAlgorithm* borrowed) {
    start_experiment = [](const Scene& wanted, BorrowedAlgorithm* of_it) {
      return session::start_under(of_it, nullptr, wanted, {});
    };
    (void)scene;
    (void)borrowed;
    return Result<std::unique_ptr<session::LiveSession>>(Error{ErrorKind::kDevice, "unplugged"});
  };
  click("identify start");
  frames(4);
  EXPECT_FALSE(runs());
  EXPECT_THAT(identify().problem, EndsWith("the device did not start again"));
}

TEST_F(IdentifyPageTest, RefusesWhatCannotBe) {
  type("identify seconds", "1");
  EXPECT_EQ(identify().choice.seconds, 8.0);
  EXPECT_EQ(refusal()->why, "1 is out of range; it takes 8 to 300 s");
  type("identify limit", "20");
  click("identify start");
  EXPECT_FALSE(runs());
  EXPECT_THAT(text(), HasSubstr("the device gives at most 8.9 N"));
  type("identify limit", "1");
  ASSERT_FALSE(application_->live()->start_recording(path("a.csv")));
  frames(2);
  click("identify start");
  EXPECT_FALSE(runs());
  EXPECT_THAT(text(), HasSubstr("Stop the recording first"));
}

TEST_F(IdentifyPageTest, AWheelWithoutAFileIsNotMoved) {
  state().identify.device = "ff";
  frames(2);
  EXPECT_THAT(text(), HasSubstr("the torque of the wheel is unknown"));
  click("identify start");
  EXPECT_FALSE(runs());
  state().identify.description = *file::load_device("force-feedback-wheel");
  click("identify start");
  EXPECT_TRUE(runs());
}

// Forces in steps of 0.1 N are not those of the model.
TEST_F(IdentifyPageTest, AModelThatDoesNotFitHasNoFile) {
  Scene coarse = scene();
  coarse.x().device.force_resolution_n = 0.1;
  EXPECT_FALSE(application_->live()->change_scene(coarse));
  start();
  frames_until([&] { return !runs() && !identify().fit.running(); });
  frames(2);
  ASSERT_TRUE(identify().result) << identify().problem;
  EXPECT_THAT(text(), HasSubstr("this model does not fit, so there are no numbers"));
  EXPECT_THAT(text(), ::testing::Not(HasSubstr("moving mass m")));
  EXPECT_FALSE(sees("identify save"));
}

}  // namespace
}  // namespace hapticwall::test
