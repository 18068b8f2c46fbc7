// Devices that speak a dialect, under the loop of a session and in virtual time: the shipped file
// of Polhem, and a knob that reports floats when it moves. They tell no force and acknowledge
// nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "app/command/device_choice.h"
#include "app/file/scene/device_file.h"
#include "tests/app/session/loop/lie_rig.h"

namespace hapticwall::session::test {
namespace {

using device::Trouble;
using device::hid::testing::FloatKnob;
using device::hid::testing::PolhemBoard;
using device::hid::testing::WoodenBoard;

constexpr std::uint64_t kBoardArmMs = 150;
constexpr std::uint64_t kBoardLieMs = 3500;

device::ImpulseEngineOptions options_of(const file::DeviceDescription& description) {
  device::ImpulseEngineOptions options = command::described_by(description);
  options.start_m = {0.03, 0.0};
  return options;
}

device::ImpulseEngineOptions polhem() { return options_of(*file::load_device("polhem-v1")); }
device::ImpulseEngineOptions wooden() { return options_of(*file::load_device("woodenhaptics")); }
device::ImpulseEngineOptions knob() {
  const auto description = file::parse_device(FloatKnob::kFile, "knob.toml");
  EXPECT_TRUE(description) << description.error().message;
  return options_of(*description);
}

template <class Board>
class BoardRig : public LieRig {
 public:
  BoardRig(const device::ImpulseEngineOptions& options, bool in_contact)
      : LieRig(options, std::make_unique<Board>(held_device(in_contact).axes[0])),
        board(dynamic_cast<Board&>(*rig.plug.foreign)) {}

  void arm_and_wait() {
    until_ms(kBoardArmMs);
    arm();
    until_ms(kBoardLieMs);
    ASSERT_EQ(arming().state, ArmingState::kOn) << arming_note_text(arming().note);
  }
  // The lie that `begin` starts is noticed: this reason, and no force at the device later than
  // `within_ms`, also when it has ended.
  void expect_zero(ArmingNote note, std::uint64_t within_ms, const std::function<void()>& begin,
                   const std::function<void()>& end) {
    arm_and_wait();
    begin();
    until_ms(kBoardLieMs + 45);
    end();
    until_ms(kBoardLieMs + 1200);
    EXPECT_EQ(arming().state, ArmingState::kOff);
    EXPECT_EQ(arming_note_text(arming().note), arming_note_text(note));
    EXPECT_LE(last_force_us, (kBoardLieMs + within_ms) * 1000);
    EXPECT_EQ(snapshot().link.trouble, Trouble::kNone);
    if (note == ArmingNote::kDevice) return;  // a new link takes the handle to be at the start
    arm();
    until_ms(kBoardLieMs + 1300);
    EXPECT_EQ(arming().note, ArmingNote::kInsideWall);  // it answers again
  }

  Board& board;
};

class PolhemRig : public BoardRig<PolhemBoard> {
 public:
  explicit PolhemRig(bool in_contact = true) : BoardRig(polhem(), in_contact) {}
};
class KnobRig : public BoardRig<FloatKnob> {
 public:
  explicit KnobRig(bool in_contact = true) : BoardRig(knob(), in_contact) {}
};

// 600 N/m, and a hand of 250 N/m 20 mm behind the face.
constexpr double kHandPushesN = 3.5;

TEST(PolhemDialect, PushesOutOfTheWallInMilliamperes) {
  PolhemRig rig;
  rig.until_ms(kBoardArmMs);
  EXPECT_EQ(rig.last_force_us, 0U);
  rig.arm_and_wait();
  EXPECT_NEAR(rig.rig.force_n(), -kHandPushesN, 0.1);
  EXPECT_NEAR(rig.snapshot().newest.x().position_m, rig.board.plant.truth().position_m,
              device::hid::testing::kEncoderM);
  const auto& written = rig.board.written;
  EXPECT_EQ(written.front(), device::hid::testing::Bytes(15));  // zero first, and no command
  EXPECT_NEAR(static_cast<double>(written.size()), kBoardLieMs, 60.0);
  for (const auto& bytes : written) {
    ASSERT_EQ(bytes.size(), 15U);
    EXPECT_TRUE(std::all_of(bytes.begin() + 3, bytes.end(), [](auto byte) { return byte == 0; }));
  }
}

TEST(PolhemDialect, TheDelayIsUnknownAndNothingIsAskedOfTheDevice) {
  PolhemRig rig;
  rig.arm_and_wait();
  const device::LinkStats link = rig.snapshot().link;
  EXPECT_EQ(link.delay_s, 0.0);
  EXPECT_EQ(link.maximum_round_trip_s, 0.0);
  EXPECT_FALSE(link.calibrated);
  const auto description = rig.rig.host.owner.description();
  ASSERT_TRUE(description);
  EXPECT_FALSE(description->describes_itself);
  EXPECT_EQ(description->axis[0].force_limit_n, 5.0);
  EXPECT_EQ(description->name, "Polhem v1, axis a");
}

TEST(PolhemDialect, PacketsThatAreAlwaysFullNeedAnotherLengthOnly) {
  device::ImpulseEngineOptions options = polhem();
  options.dialect->in.bytes = options.dialect->out.bytes = 64;
  LieRig rig(options, std::make_unique<PolhemBoard>(held_device(true).axes[0], 64));
  rig.until_ms(kBoardArmMs);
  rig.arm();
  rig.until_ms(kBoardLieMs);
  EXPECT_NEAR(rig.rig.force_n(), -kHandPushesN, 0.1);
}

TEST(PolhemDialect, AJumpEndsTheForceInTheNextTick) {
  for (const double jump_m : {0.05, -0.05, 0.7, -0.012}) {
    PolhemRig rig;
    rig.expect_zero(
        ArmingNote::kImplausible, 1, [&] { rig.board.jump_m = jump_m; },
        [&] { rig.board.jump_m = 0.0; });
  }
}

// It reports its encoders once for each command: without commands it is silent. The first command
// of the next link is zero.
TEST(PolhemDialect, WritesThatDoNotArriveAreALoss) {
  PolhemRig refused;
  refused.expect_zero(
      ArmingNote::kDevice, 80, [&] { refused.board.refuses = true; },
      [&] { refused.board.refuses = false; });
  PolhemRig blocked;
  blocked.expect_zero(
      ArmingNote::kDevice, 46, [&] { blocked.board.blocks = true; },
      [&] { blocked.board.blocks = false; });
}

TEST(PolhemDialect, SilenceIsALoss) {
  PolhemRig rig;
  rig.arm_and_wait();
  rig.board.silent = true;
  rig.until_ms(kBoardLieMs + 30);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kSilent);
  EXPECT_LE(rig.last_force_us, (kBoardLieMs + 22) * 1000);
  rig.board.silent = false;
  rig.until_ms(kBoardLieMs + 1500);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kNone);
  EXPECT_EQ(rig.rig.force_n(), 0.0);
}

// There is no time to live in its reports: the writer sends the zero.
TEST(PolhemDialect, ALoopThatStandsStillEndsTheForceWithoutTheWatchdogOfTheDevice) {
  PolhemRig rig;
  rig.arm_and_wait();
  ASSERT_NE(rig.rig.force_n(), 0.0);
  rig.rig.host.loop_stalled = true;
  rig.until_ms(kBoardLieMs + 200);
  EXPECT_LE(rig.last_force_us, (kBoardLieMs + 31) * 1000);
  EXPECT_GE(rig.last_force_us, (kBoardLieMs + 18) * 1000);
}

TEST(PolhemDialect, AnUnpluggedBoardComesBackWithoutForce) {
  PolhemRig rig;
  rig.arm_and_wait();
  rig.rig.plug.hidden = true;
  rig.until_ms(kBoardLieMs + 60);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kUnplugged);
  rig.rig.plug.hidden = false;
  rig.until_ms(kBoardLieMs + 1500);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kNone);
  EXPECT_EQ(rig.rig.force_n(), 0.0);
}

TEST(WoodenDialect, PushesOutOfTheWallThoughItsEncoderCountsBackwards) {
  BoardRig<WoodenBoard> rig(wooden(), true);
  rig.arm_and_wait();
  EXPECT_NEAR(rig.rig.force_n(), -kHandPushesN, 0.1);
  EXPECT_NEAR(rig.snapshot().newest.x().position_m, rig.board.plant.truth().position_m,
              device::hid::testing::kEncoderM);
}

// It has the same numbers on the bus as Polhem.
TEST(WoodenDialect, NeverPushesByTheFileOfAnotherBoard) {
  device::testing::Rig rig(polhem(), std::make_unique<WoodenBoard>(held_device(true).axes[0]));
  EXPECT_FALSE(rig.host.come_up());
  rig.host.arm();
  rig.tick_until_ms(kBoardLieMs);
  EXPECT_EQ(rig.last_force_us, 0U);
  EXPECT_TRUE(rig.saw(Trouble::kRefused));
  EXPECT_THAT(rig.host.owner.words(), ::testing::HasSubstr("none has the length and id"));
}

TEST(KnobDialect, RestsWithoutAReportAndPushesBackwards) {
  KnobRig rig(false);
  rig.arm_and_wait();
  const std::uint64_t before = rig.snapshot().link.states;
  rig.until_ms(kBoardLieMs + 2000);  // no report since the hand holds it
  EXPECT_EQ(rig.arming().state, ArmingState::kOn);
  EXPECT_NEAR(static_cast<double>(rig.snapshot().link.states - before), 400.0, 40.0);  // 5 ms
  EXPECT_LE(rig.snapshot().link.maximum_age_s, 0.01);
  KnobRig pushing;
  pushing.arm_and_wait();
  EXPECT_NEAR(pushing.rig.force_n(), -kHandPushesN, 0.1);
}

TEST(KnobDialect, APositionThatIsNoNumberEndsTheForce) {
  KnobRig rig;
  rig.arm_and_wait();
  rig.board.breaks = true;
  rig.until_ms(kBoardLieMs + 20);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kEncoder);
  EXPECT_LE(rig.last_force_us, (kBoardLieMs + 1) * 1000);
}

// The zero arrives with the first write that the board takes.
TEST(KnobDialect, WritesThatDoNotArriveDisarmAndTheForceStaysAway) {
  KnobRig refused;
  refused.expect_zero(
      ArmingNote::kRejected, 46, [&] { refused.board.refuses = true; },
      [&] { refused.board.refuses = false; });
  KnobRig blocked;
  blocked.expect_zero(
      ArmingNote::kNoAnswer, 46, [&] { blocked.board.blocks = true; },
      [&] { blocked.board.blocks = false; });
}

TEST(KnobDialect, AJumpOutOfRestIsNoticed) {
  KnobRig rig(false);
  rig.arm_and_wait();
  rig.board.jump_m = 0.15;
  rig.until_ms(kBoardLieMs + 20);
  EXPECT_EQ(rig.arming().note, ArmingNote::kImplausible);
}

TEST(KnobDialect, AnUnplugIsNoRest) {
  KnobRig rig;
  rig.arm_and_wait();
  rig.rig.plug.hidden = true;
  rig.until_ms(kBoardLieMs + 30);
  EXPECT_EQ(rig.snapshot().link.trouble, Trouble::kUnplugged);
  EXPECT_EQ(rig.arming().state, ArmingState::kOff);
}

TEST(Dialects, AFileSaysHowOftenItReportsAndIsWrittenTo) {
  auto description = *file::parse_device(FloatKnob::kFile, "knob.toml");
  description.rate_hz = 250.0;
  const device::ImpulseEngineOptions options = options_of(description);
  EXPECT_EQ(options.rate_hz, 250.0);
  EXPECT_EQ(options.keep_alive_ns, 5'000'000);
}

TEST(Dialects, AnotherInterfaceOfTheSameBoardIsNotTaken) {
  device::ImpulseEngineOptions options = polhem();
  options.dialect->usage_page = 0xFFC9;
  device::testing::Rig rig(options, std::make_unique<PolhemBoard>(held_device(false).axes[0]));
  EXPECT_FALSE(rig.host.come_up());
  EXPECT_NE(rig.host.owner.words().find("no haptic device 1234:0006"), std::string::npos);
  rig.plug.listing.usage_page = 0xFFC9;
  EXPECT_TRUE(rig.host.come_up());
}

}  // namespace
}  // namespace hapticwall::session::test
