// A loss of the link says which: unplugged, silent, void reports, or a program that was held up.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/device/link/link_rig.h"

namespace hapticwall::device {
namespace {

using hid::FaultKind;
using testing::kMillisecondUs;
using testing::Rig;

constexpr std::uint64_t kLostFromMs = 300;
constexpr std::uint64_t kForGoodUs = 1'000'000'000;

// The owner's words are the loop's, the force is off, and it stays off for a second.
void expect_loss(Rig& rig, Trouble trouble) {
  ASSERT_TRUE(rig.host.ticks_until([&] { return !rig.host.troubles.empty(); }, 100));
  EXPECT_EQ(rig.host.stats().trouble, trouble) << trouble_text(rig.host.stats().trouble);
  ASSERT_TRUE(rig.host.ticks_until([&] { return !rig.host.owner.words().empty(); }, 10));
  EXPECT_EQ(rig.host.owner.words(), "/dev/hidraw0: " + std::string(trouble_text(trouble)));
  EXPECT_EQ(rig.host.exchange.status.load().reason, trouble);
  rig.host.ticks(22);
  bool pushes = false;
  rig.host.after_tick = [&] { pushes = pushes || rig.force_n() != 0.0; };
  rig.host.ticks(1000);
  EXPECT_FALSE(pushes);
}

struct DeviceLoss {
  FaultKind kind;
  Trouble trouble;
};

TEST(LinkLoss, TellsWhatTheDeviceDid) {
  constexpr DeviceLoss kLosses[] = {
      {FaultKind::kUnplugged, Trouble::kUnplugged}, {FaultKind::kSilent, Trouble::kSilent},
      {FaultKind::kRepeated, Trouble::kSilent},     {FaultKind::kShort, Trouble::kVoid},
      {FaultKind::kWrongId, Trouble::kVoid},        {FaultKind::kWrongMajor, Trouble::kVoid},
      {FaultKind::kBadCrc, Trouble::kVoid}};
  for (const DeviceLoss& loss : kLosses) {
    SCOPED_TRACE(static_cast<int>(loss.kind));
    Rig rig({{loss.kind, kLostFromMs * kMillisecondUs, kForGoodUs}});
    rig.drive_until_ms(kLostFromMs - 1);
    expect_loss(rig, loss.trouble);
  }
}

// One void report, then silence.
TEST(LinkLoss, AVoidReportOfLongAgoIsNoReason) {
  Rig rig({{FaultKind::kBadCrc, kLostFromMs * kMillisecondUs, kMillisecondUs},
           {FaultKind::kSilent, (kLostFromMs + 1) * kMillisecondUs, kForGoodUs}});
  rig.drive_until_ms(kLostFromMs - 1);
  expect_loss(rig, Trouble::kSilent);
}

TEST(LinkLoss, AHostThatWasHeldUpDoesNotBlameTheDevice) {
  for (const int held_up_ms : {25, 70, 1000}) {
    for (const bool all : {false, true}) {  // the whole program, or the reader alone
      SCOPED_TRACE(held_up_ms);
      Rig rig;
      rig.drive_until_ms(kLostFromMs);
      (all ? rig.host.stalled : rig.host.reader_stalled) = true;
      rig.host.ticks(held_up_ms);
      rig.host.stalled = rig.host.reader_stalled = false;
      expect_loss(rig, Trouble::kHeldUp);
    }
  }
}

// The loop and the owner wake up before the reader does.
TEST(LinkLoss, AHostThatWasHeldUpKnowsItBeforeItsReaderRuns) {
  Rig rig;
  rig.drive_until_ms(kLostFromMs);
  rig.host.stalled = rig.host.reader_stalled = true;
  rig.host.ticks(500);
  rig.host.stalled = false;
  expect_loss(rig, Trouble::kHeldUp);
}

TEST(LinkLoss, AnUnplugIsToldByAHostThatWasHeldUpMeanwhile) {
  Rig rig;
  rig.drive_until_ms(kLostFromMs);
  rig.host.stalled = true;
  rig.host.ticks(100);
  rig.plug.hidden = true;
  rig.host.ticks(100);
  rig.host.stalled = false;
  expect_loss(rig, Trouble::kUnplugged);
}

TEST(LinkLoss, NothingButTwentyMillisecondsOfListeningIsSilence) {
  constexpr std::int64_t kFirstNs = 5'000'000'000;
  Listening listening;
  listening.begin(kFirstNs);
  std::int64_t now_ns = kFirstNs;
  const auto listen_until = [&](std::int64_t end_ns) {
    for (; now_ns < end_ns; now_ns += kMaxDeafNs) listening.heard(now_ns, false);
    now_ns = end_ns;
    listening.heard(now_ns, false);
  };
  listen_until(kFirstNs + kLinkLostNs);
  EXPECT_EQ(listening.cause(now_ns), Trouble::kHeldUp);
  EXPECT_EQ(listening.cause(now_ns + 1), Trouble::kSilent);
  EXPECT_EQ(listening.cause(now_ns + kMaxDeafNs), Trouble::kSilent);
  EXPECT_EQ(listening.cause(now_ns + kMaxDeafNs + 1), Trouble::kHeldUp);
  listening.heard_void(now_ns);
  EXPECT_EQ(listening.cause(now_ns + kMaxDeafNs), Trouble::kVoid);
  listening.heard(now_ns, true);
  EXPECT_EQ(listening.cause(now_ns), Trouble::kUnplugged);
  now_ns += kMaxDeafNs + 1;  // too long without a read
  listening.heard(now_ns, false);
  EXPECT_EQ(listening.cause(now_ns), Trouble::kHeldUp);
  listen_until(now_ns + kLinkLostNs + 1);
  EXPECT_EQ(listening.cause(now_ns), Trouble::kSilent);
}

}  // namespace
}  // namespace hapticwall::device
