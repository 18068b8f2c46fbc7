// A device behind a library that lies, under the loop of a session and in virtual time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "device/port/plugin_port.h"
#include "tests/app/session/loop/lie_rig.h"
#include "tests/temporary_folder.h"

namespace hapticwall::session::test {
namespace {

using device::Trouble;
using ::testing::HasSubstr;

constexpr std::uint64_t kLibraryLieMs = 3500;
constexpr std::uint64_t kHangMs = 50;

// Plant behind the library; the bus moves it.
class LibraryBoard : public device::hid::testing::ForeignBoard {
 public:
  using ForeignBoard::ForeignBoard;
  [[nodiscard]] double force_n() const override { return -newest.force_n; }
  [[nodiscard]] double place_m() const { return position_m(); }

  hw_device_command newest{};
  std::uint32_t flags = HW_DEVICE_ANSWERS;

 protected:
  std::vector<device::hid::testing::Bytes> reports() override { return {}; }
  void obey(std::span<const std::uint8_t> /*bytes*/) override {}
};

// The library has no state of a caller: one at a time.
LibraryBoard* the_board = nullptr;
device::testing::VirtualHost* the_host = nullptr;
int opened = 0;
int closed = 0;
std::function<int(hw_device_reading&)> lie;  // after the true reading; HW_READ_POSITION: go on

int library_info(hw_device_info* info) {
  info->flags = the_board == nullptr ? 0 : the_board->flags;
  info->encoder_m = device::hid::testing::kEncoderM;
  info->force_limit_n = 6.0;
  info->min_m = -0.1;
  info->max_m = 0.2;
  info->max_speed_m_per_s = 5.0;
  return 0;
}
int library_open() {
  ++opened;
  return 0;
}
int library_read(hw_device_reading* reading) {
  reading->position_m = the_board->place_m();
  reading->command = the_board->newest.number;
  reading->force_n = the_board->newest.force_n;
  if (the_board->newest.enable != 0) reading->flags = HW_READING_ENABLED;
  return lie ? lie(*reading) : HW_READ_POSITION;
}
int library_write(const hw_device_command* command) {
  if (the_board->refuses) return 1;
  the_board->newest = *command;
  return 0;
}
void library_close() { ++closed; }
const char* library_words() { return "an own word"; }

const hw_device_plugin kLibrary = {HAPTICWALL_DEVICE_ABI,
                                   sizeof(hw_device_plugin),
                                   "Library",
                                   library_info,
                                   library_open,
                                   library_read,
                                   library_write,
                                   library_close,
                                   library_words};

class LibraryLies : public hapticwall::test::FolderTest {
 protected:
  void SetUp() override {
    put("device.so", "");
    lie = {};
    opened = closed = 0;
  }
  void TearDown() override {
    rig_.reset();
    the_board = nullptr;
    the_host = nullptr;
  }
  [[nodiscard]] static device::HostClock clock() {
    return [] { return the_host == nullptr ? 0 : the_host->now_ns(); };
  }
  LieRig& start(std::uint32_t flags = HW_DEVICE_ANSWERS) {
    rig_.reset();
    the_host = nullptr;
    auto board = std::make_unique<LibraryBoard>(held_device(true).axes[0]);
    the_board = board.get();
    the_board->flags = flags;
    const auto plugin = device::describe_plugin(kLibrary, path("device.so"));
    EXPECT_TRUE(plugin);
    device::ImpulseEngineOptions options = device::options_of(*plugin);
    options.start_m = {0.03, 0.0};
    const auto port = std::make_shared<device::PluginPort>(*plugin, clock());
    rig_ = std::make_unique<LieRig>(options, std::move(board), port,
                                    [](device::testing::VirtualHost& host) { the_host = &host; });
    rig_->until_ms(150);
    rig_->arm();
    rig_->until_ms(kLibraryLieMs);
    EXPECT_EQ(rig_->arming().state, ArmingState::kOn) << arming_note_text(rig_->arming().note);
    EXPECT_NEAR(rig_->rig.force_n(), -3.5, 0.3);
    return *rig_;
  }
  // Zero within `within_ms` after the lie began, with one sentence, and it stays zero.
  void expect_zero(std::string_view sentence, std::uint64_t within_ms) {
    std::string heard;
    rig_->until_ms(kLibraryLieMs + kHangMs);
    const device::LinkStats link = rig_->snapshot().link;
    heard = link.trouble != Trouble::kNone ? trouble_text(link.trouble)
                                           : arming_note_text(rig_->arming().note);
    EXPECT_EQ(heard, sentence);
    rig_->until_ms(kLibraryLieMs + 600);
    EXPECT_EQ(rig_->arming().state, ArmingState::kOff);
    EXPECT_LE(rig_->last_force_us, (kLibraryLieMs + within_ms) * 1000);
  }

  std::unique_ptr<LieRig> rig_;
};

TEST_F(LibraryLies, AnHonestOnePushesAndItsDelayIsMeasured) {
  LieRig& rig = start();
  EXPECT_NEAR(rig.snapshot().link.delay_s, 1e-3, 0.5e-3);
  EXPECT_EQ(opened, 1);
  EXPECT_EQ(rig.rig.host.owner.description()->axis[0].force_limit_n, 6.0);
  rig.rig.host.owner.stop();
  rig.until_ms(kLibraryLieMs + 200);
  EXPECT_EQ(rig.rig.force_n(), 0.0);
  EXPECT_EQ(the_board->newest.enable, 0U);
  EXPECT_EQ(closed, 1);
}

TEST_F(LibraryLies, WithoutAnswersTheDelayIsUnknown) {
  const device::LinkStats link = start(0).snapshot().link;
  EXPECT_EQ(link.delay_s, 0.0);
  EXPECT_EQ(link.maximum_round_trip_s, 0.0);
}

TEST_F(LibraryLies, APositionThatIsNoNumber) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    start();
    lie = [bad](hw_device_reading& reading) { return reading.position_m = bad, HW_READ_POSITION; };
    expect_zero("an encoder of the device has failed", 1);
    lie = {};
  }
}

TEST_F(LibraryLies, AJump) {
  for (const double jump_m : {0.03, -0.03, 5.0}) {
    start();
    the_board->jump_m = jump_m;
    expect_zero("the position jumped farther than the handle can move", 1);
  }
}

// The force rests at the device until its write returns: docs/plugins.md.
TEST_F(LibraryLies, AWriteThatTakes50Ms) {
  LieRig& rig = start();
  the_board->blocks = true;
  rig.until_ms(kLibraryLieMs + kHangMs - 1);
  the_board->blocks = false;
  expect_zero("the device acknowledges no command", kHangMs);
}

TEST_F(LibraryLies, AReadThatTakes50Ms) {
  LieRig& rig = start();
  rig.rig.host.reader_stalled = true;
  rig.until_ms(kLibraryLieMs + 30);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kSilent);
  rig.until_ms(kLibraryLieMs + kHangMs);
  rig.rig.host.reader_stalled = false;
  rig.until_ms(kLibraryLieMs + 600);
  EXPECT_LE(rig.last_force_us, (kLibraryLieMs + 21) * 1000);
  EXPECT_EQ(rig.arming().state, ArmingState::kOff);
}

TEST_F(LibraryLies, RefusedWrites) {
  for (const std::uint32_t flags : {std::uint32_t{0}, std::uint32_t{HW_DEVICE_ANSWERS}}) {
    LieRig& rig = start(flags);
    the_board->refuses = true;
    rig.until_ms(kLibraryLieMs + 10);
    the_board->refuses = false;
    expect_zero("the device rejects commands", 11);
  }
}

TEST_F(LibraryLies, AFaultOfItsOwn) {
  start();
  lie = [](hw_device_reading& reading) {
    return reading.flags |= HW_READING_FAULT, HW_READ_POSITION;
  };
  expect_zero("the device reports a fault specific to it", 1);
}

TEST_F(LibraryLies, ADeviceThatIsGoneIsOpenedAgainWithoutForce) {
  LieRig& rig = start();
  lie = [](hw_device_reading&) { return HW_READ_FAILED; };
  expect_zero("the device was unplugged", 22);
  EXPECT_GE(closed, 1);
  lie = {};
  rig.until_ms(kLibraryLieMs + 2500);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kNone);
  EXPECT_EQ(opened, closed + 1);
  EXPECT_EQ(rig.rig.force_n(), 0.0);
}

TEST_F(LibraryLies, AnExceptionIsAFailure) {
  start();
  lie = [](hw_device_reading&) -> int { throw std::runtime_error("a fault"); };
  expect_zero("the device was unplugged", 22);
  lie = {};
}

TEST_F(LibraryLies, AnotherRoundingModeIsAFailureAndNeverLeavesTheCall) {
  start();
  lie = [](hw_device_reading&) { return std::fesetround(FE_UPWARD), HW_READ_POSITION; };
  expect_zero("the device was unplugged", 22);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  EXPECT_THAT(device::device_plugin_fault(), HasSubstr("read() changed the rounding mode"));
  lie = {};
}

TEST_F(LibraryLies, ItIsNotEnabledOrGivesAnotherForce) {
  start();
  lie = [](hw_device_reading& reading) { return reading.flags = 0, HW_READ_POSITION; };
  expect_zero("the device says that it is not enabled", 1);
  lie = {};
  start();
  lie = [](hw_device_reading& reading) {
    return reading.force_n = 0.5 * reading.force_n, HW_READ_POSITION;
  };
  expect_zero("the device says that it gives another force than the commanded one", 5);
  lie = {};
}

TEST_F(LibraryLies, ALoopThatStandsStillEndsTheForce) {
  LieRig& rig = start();
  rig.rig.host.loop_stalled = true;
  rig.until_ms(kLibraryLieMs + 200);
  EXPECT_LE(rig.last_force_us, (kLibraryLieMs + 31) * 1000);
}

TEST_F(LibraryLies, ASecondHostIsTold) {
  start();
  device::PluginPort second(*device::describe_plugin(kLibrary, path("device.so")), clock());
  const auto handle = second.open(path("device.so"));
  ASSERT_FALSE(handle);
  EXPECT_THAT(handle.error().message, HasSubstr("device.so is in use by "));
  EXPECT_EQ(opened, 1);
}

// A handle of the link before is still in a call.
TEST_F(LibraryLies, ItIsNotOpenedAgainBeforeEveryCallHasReturned) {
  start();
  rig_.reset();
  device::PluginPort port(*device::describe_plugin(kLibrary, path("device.so")), clock());
  auto to_read = port.open(path("device.so"));
  auto to_write = port.open(path("device.so"));
  ASSERT_TRUE(to_read && to_write);
  const int before = closed;
  to_read->reset();
  EXPECT_EQ(closed, before);
  const auto early = port.open(path("device.so"));
  ASSERT_FALSE(early);
  EXPECT_THAT(early.error().message, HasSubstr("a call of the library has not returned"));
  to_write->reset();
  EXPECT_EQ(closed, before + 1);
  EXPECT_TRUE(port.open(path("device.so")));
}

}  // namespace
}  // namespace hapticwall::session::test
