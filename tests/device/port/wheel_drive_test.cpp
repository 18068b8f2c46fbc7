// Tests the commands to a wheel, in virtual time.
#include "device/port/wheel_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "device/link/link_loop.h"
#include "device/link/link_writer.h"
#include "device/port/wheel_port.h"
#include "tests/device/port/fake_wheel.h"

namespace hapticwall::device::evdev::test {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr double kRateHz = 900.0;
constexpr double kTwoLevelsN = 2.4e-3;  // two levels of a wheel of 38.46 N

// 5 N m at 0.13 m: 38.46 N at full level.
WheelDescription wheel_of_5_nm() {
  WheelDescription wheel;
  wheel.torque_nm = 5.0;
  return wheel;
}

TEST(WheelScale, MetresAtTheHand) {
  const WheelScale scale(wheel_of_5_nm(), {0, 65535});
  const double travel_m = wheel_of_5_nm().travel_m();
  EXPECT_NEAR(travel_m, 2.0420, 1e-4) << "900 degrees at 0.13 m";
  EXPECT_NEAR(scale.encoder_m(), 31.16e-6, 1e-8);
  const double half_count_m = scale.encoder_m() / 2.0;
  EXPECT_NEAR(scale.position_m(65535) + half_count_m, travel_m / 2.0, 1e-9);
  EXPECT_NEAR(scale.position_m(0) + half_count_m, -travel_m / 2.0, 1e-9);
}

TEST(WheelScale, NewtonsAreLevelsWithinTheLimit) {
  const WheelScale scale(wheel_of_5_nm(), kFakeAxis);
  EXPECT_EQ(scale.limit_n(), 5.0);
  EXPECT_EQ(scale.level(1.0), 851);  // 1 / 38.46 of 32767
  EXPECT_EQ(scale.level(-1.0), -851);
  EXPECT_EQ(scale.level(5.0), 4259);
  EXPECT_EQ(scale.level(1e9), 4259);
  EXPECT_EQ(scale.level(-1e9), -4259);
  EXPECT_EQ(scale.level(std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(scale.level(std::nan("")), 0);
}

TEST(WheelScale, TheSignIsInTheLevel) {
  WheelDescription wheel = wheel_of_5_nm();
  wheel.sign = -1.0;
  EXPECT_EQ(WheelScale(wheel, kFakeAxis).level(1.0), -851);
}

TEST(WheelScale, AWeakWheelLimitsItself) {
  WheelDescription wheel = wheel_of_5_nm();
  wheel.torque_nm = 0.26;
  const WheelScale scale(wheel, kFakeAxis);
  EXPECT_DOUBLE_EQ(scale.limit_n(), 2.0);
  EXPECT_EQ(scale.level(5.0), kFullLevel);
}

// Loop, writer of the link and wheel, stepped by hand.
class Driven {
 public:
  explicit Driven(double rate_hz = kRateHz) : listing(fake_listing()) {
    listing.max_rate_hz = rate_hz;
    static_cast<void>(port.list());
    reader = opened();
    begin_session(1);
    exchange.status = {1, Trouble::kNone};
    publish();
    static_cast<void>(loop.read());
  }
  std::unique_ptr<hid::Handle> opened() { return std::move(*port.open(listing.node.path())); }
  void begin_session(std::uint32_t number) {
    session = std::make_unique<WriteSession>(number, opened(), std::make_shared<SentCommands>(),
                                             exchange, options_of(WheelOptions{}).keep_alive_ns);
  }
  void publish() {
    LinkView view;
    view.session = 1;
    view.received_ns = now_ns;
    view.limit_n[0] = wheel_of_5_nm().limit_n();
    exchange.views.publish(view);
  }
  // A tick of the loop.
  void command(double force_n) {
    publish();
    static_cast<void>(loop.read());
    loop.write({force_n, 0.0});
  }
  // The writer's thread for so long, with the reports that the bus takes.
  void pass(std::int64_t length_ns) {
    const std::int64_t end_ns = now_ns + length_ns;
    while (now_ns < end_ns) {
      const std::int64_t free_ns = session->handle().free_ns();
      const bool works = now_ns >= free_ns && !session->over();
      const auto bytes = works ? session->begin(now_ns) : std::nullopt;
      if (bytes) {
        session->handle().write(*bytes);
        session->finish(now_ns);
      }
      const std::int64_t next_ns = bytes ? now_ns : works ? now_ns + kMs : free_ns;
      now_ns = std::max(now_ns + 1, std::min(end_ns, next_ns));
    }
  }
  void tick(double force_n) {
    command(force_n);
    pass(kMs);
  }
  [[nodiscard]] double motor_n() const { return wheel.motor() / 32767.0 * 5.0 / 0.13; }
  hid::ReadKind read() { return reader->read(state, 1).kind; }
  // Of the newest state.
  double told_n() {
    if (read() != hid::ReadKind::kReport) return 0.0;
    return 0.0 - hid::decode_state(state).report()->applied_force_n[0];
  }

  std::int64_t now_ns = 1'000'000'000;
  HostClock clock = [this] { return now_ns; };
  std::shared_ptr<FakeWheel> node = std::make_shared<FakeWheel>(clock);
  FakeWheel& wheel = *node;
  WheelListing listing;
  WheelPort port{wheel_of_5_nm(),
                 {[this] { return std::vector{listing}; },
                  [this](const WheelListing&) { return Result<std::shared_ptr<WheelNode>>(node); }},
                 clock};
  LinkExchange exchange;
  LinkLoop loop{exchange, clock};
  std::unique_ptr<hid::Handle> reader;
  hid::ReportBytes state{};
  std::unique_ptr<WriteSession> session;
};

TEST(WheelWriter, IsSilentFor10MsAfterTheForceWasMade) {
  Driven driven;
  driven.loop.enable(true);
  for (int ms = 0; ms < 10; ++ms) driven.tick(2.0);
  EXPECT_EQ(driven.wheel.reports, 0U);
  for (int ms = 0; ms < 5; ++ms) driven.tick(2.0);
  EXPECT_NEAR(driven.motor_n(), 2.0, kTwoLevelsN);
}

TEST(WheelWriter, NoForceUnlessEnabled) {
  Driven driven;
  for (int ms = 0; ms < 50; ++ms) driven.tick(2.0);
  EXPECT_EQ(driven.wheel.reports, 0U);
}

TEST(WheelWriter, TheForceStandsAsLongAsCommandsCome) {
  Driven driven;
  driven.loop.enable(true);
  for (int ms = 0; ms < 15; ++ms) driven.tick(2.0);
  const std::uint64_t before = driven.wheel.reports;
  for (int ms = 0; ms < 500; ++ms) {
    driven.tick(2.0);
    ASSERT_NEAR(driven.motor_n(), 2.0, kTwoLevelsN) << ms;
  }
  EXPECT_EQ(driven.wheel.reports - before, 54U) << "18 plays, and twice the level beside";
}

TEST(WheelWriter, DisablingTakesLevelPlayAndGain) {
  Driven driven;
  driven.loop.enable(true);
  for (int ms = 0; ms < 15; ++ms) driven.tick(2.0);
  driven.loop.enable(false);
  driven.tick(2.0);
  driven.pass(kMs);
  EXPECT_EQ(driven.wheel.motor(), 0);
  driven.pass(10 * kMs);
  EXPECT_TRUE(driven.wheel.is_quiet()) << "level, play and gain";
  const std::uint64_t reports = driven.wheel.reports;
  for (int ms = 0; ms < 100; ++ms) driven.tick(2.0);
  EXPECT_EQ(driven.wheel.reports, reports) << "three reports, then none";
}

// A full queue drops reports, and the kernel says that it took them.
TEST(WheelWriter, ALevelThatWasDroppedIsSentAgain) {
  for (const double force_n : {3.0, 0.0, -3.0}) {
    Driven driven;
    driven.loop.enable(true);
    for (int ms = 0; ms < 30; ++ms) driven.tick(2.0);
    driven.wheel.deaf = true;
    for (int ms = 0; ms < 3; ++ms) driven.tick(force_n);
    driven.wheel.deaf = false;
    EXPECT_NEAR(driven.motor_n(), 2.0, kTwoLevelsN);
    for (int ms = 0; ms < 30; ++ms) driven.tick(force_n);
    EXPECT_NEAR(driven.motor_n(), force_n, kTwoLevelsN);
  }
}

TEST(WheelWriter, TellsTheForceThatTheKernelTook) {
  Driven driven;
  for (int ms = 0; ms < 30; ++ms) driven.tick(2.0);
  EXPECT_EQ(driven.told_n(), 0.0) << "not enabled";
  driven.loop.enable(true);
  for (int ms = 0; ms < 30; ++ms) {
    driven.tick(2.0);
    ASSERT_NEAR(driven.told_n(), driven.motor_n(), 0.51e-3) << ms << ": in millinewtons";
  }
  EXPECT_NEAR(driven.told_n(), 2.0, kTwoLevelsN);
  driven.loop.enable(false);
  driven.tick(2.0);
  driven.pass(10 * kMs);
  EXPECT_EQ(driven.told_n(), 0.0);
  driven.loop.enable(true);
  for (int ms = 0; ms < 30; ++ms) driven.tick(2.0);
  driven.wheel.gone = true;
  driven.tick(1.0);
  EXPECT_EQ(driven.told_n(), 0.0) << "unplugged";
}

TEST(WheelWriter, AnOldCommandIsNoForce) {
  Driven driven;
  driven.loop.enable(true);
  for (int ms = 0; ms < 15; ++ms) driven.tick(2.0);
  driven.pass(19 * kMs);
  EXPECT_NE(driven.wheel.motor(), 0);
  driven.pass(10 * kMs);
  EXPECT_EQ(driven.wheel.motor(), 0);
}

TEST(WheelWriter, AProcessThatStandsStillLeavesTheEndToTheWheel) {
  Driven driven;
  driven.loop.enable(true);
  for (int ms = 0; ms < 15; ++ms) driven.tick(2.0);
  driven.now_ns += 99 * kMs;
  EXPECT_EQ(driven.wheel.motor(), 0);
}

TEST(WheelWriter, SendsNoMoreThanTheBusTakesAndTheNewestOnly) {
  for (const double rate_hz : {112.5, 400.0, 900.0}) {
    Driven driven(rate_hz);
    driven.loop.enable(true);
    for (int ms = 0; ms < 1000; ++ms) driven.tick(ms % 2 == 0 ? 1.0 : 2.0);
    EXPECT_LE(static_cast<double>(driven.wheel.reports), rate_hz + 1.0);
    EXPECT_GT(static_cast<double>(driven.wheel.reports), 0.8 * rate_hz);
    driven.tick(3.0);
    driven.pass(10 * kMs);
    EXPECT_NEAR(driven.motor_n(), 3.0, kTwoLevelsN);
  }
}

TEST(WheelWriter, StopsWithoutForceAndNoticesThatTheWheelIsGone) {
  Driven driven;
  driven.loop.enable(true);
  for (int ms = 0; ms < 15; ++ms) driven.tick(2.0);
  driven.session->stop();
  driven.pass(10 * kMs);
  EXPECT_TRUE(driven.session->over());
  EXPECT_EQ(driven.wheel.motor(), 0);
  driven.reader.reset();
  driven.session.reset();
  EXPECT_TRUE(driven.wheel.is_quiet()) << "level, play and gain";

  Driven unplugged;
  unplugged.loop.enable(true);
  for (int ms = 0; ms < 15; ++ms) unplugged.tick(2.0);
  unplugged.wheel.gone = true;
  unplugged.tick(1.0);
  unplugged.wheel.gone = false;
  EXPECT_EQ(unplugged.read(), hid::ReadKind::kGone) << "it did not take a report";
}

TEST(WheelWriter, ACommandForAnEarlierLinkIsNoForce) {
  Driven driven;
  driven.loop.enable(true);
  driven.command(2.0);
  driven.begin_session(2);
  driven.pass(19 * kMs);
  EXPECT_EQ(driven.wheel.reports, 0U);
}

// Commands, faults and stalls in any order: never more than the limit, no force before arming, none
// after the time that taking it away needs.
TEST(WheelWriter, NoScriptOf2000GivesAForbiddenForce) {
  constexpr std::int64_t kSlack = 34 * kMs;  // a write of 30 ms, two intervals and a tick
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    const auto draw = [&](int below) {
      return static_cast<int>(random() % static_cast<unsigned>(below));
    };
    Driven driven;
    bool armed = false;
    std::int64_t allowed_until_ns = driven.now_ns;
    for (int tick = 0; tick < 150; ++tick) {
      const double wishes[] = {0.0, 3.0, -3.0, 50.0, -1e12, std::nan(""), INFINITY};
      switch (draw(12)) {
        case 0:
          armed = !armed;
          driven.loop.enable(armed);
          break;
        case 1:  // the loop stands still
          driven.pass(draw(60) * kMs);
          break;
        case 2:  // a write that takes long
          driven.wheel.on_report = [&driven, length = draw(30) * kMs] {
            driven.now_ns += length;
            driven.wheel.on_report = {};
          };
          break;
        default:
          break;
      }
      driven.command(wishes[draw(7)]);
      if (armed) allowed_until_ns = driven.now_ns + kLinkLostNs + kSlack;
      if (!armed) allowed_until_ns = std::min(allowed_until_ns, driven.now_ns + kSlack);
      for (int part = 0; part < 4; ++part) {
        driven.pass(kMs / 4);
        ASSERT_LE(std::abs(driven.motor_n()), 5.0) << seed;
        if (driven.now_ns > allowed_until_ns) ASSERT_EQ(driven.wheel.motor(), 0) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace hapticwall::device::evdev::test
