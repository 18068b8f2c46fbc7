// hapticwall timing: metrics and verdict of invented measurements, and a short real one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "app/command/device/timing_report.h"
#include "app/session/loop/timing_probe.h"
#include "tests/app/command/binary.h"
#include "tests/app/session/support.h"

namespace hapticwall::command::test {
namespace {

using session::Quantiles;
using session::TimingPlan;
using session::TimingRecord;

constexpr std::int64_t kMicrosecondNs = 1000;
constexpr std::int64_t kPeriodNs = 1'000'000;

TimingPlan usual_plan() { return {1000.0, 10'000, -1}; }

TimingRecord quiet_record() {
  TimingRecord record;
  record.status.text = "real-time priority 80, memory locked, any core";
  record.latency_ns.assign(10'000, 5 * kMicrosecondNs);
  record.compute_ns.assign(10'000, 2 * kMicrosecondNs);
  return record;
}

TimingRecord quiet_device() {
  TimingRecord record = quiet_record();
  record.age_ns.assign(10'000, kPeriodNs / 2);
  record.round_trip_ns.assign(10'000, kPeriodNs * 6 / 10);
  record.write_ns.assign(10'000, 30 * kMicrosecondNs);
  record.link.connected = true;
  record.link.states = 10'000;
  record.link.device_period_s = 1e-3;
  record.link.delay_s = 1e-3;
  return record;
}

TEST(TimingQuantiles, AreTheNearestRanks) {
  std::vector<std::int64_t> values;
  for (std::int64_t i = 1000; i >= 1; --i) values.push_back(i);
  const Quantiles result = session::quantiles(values);
  EXPECT_EQ(result.count, 1000U);
  EXPECT_EQ(result.median_ns, 500);
  EXPECT_EQ(result.p99_ns, 990);
  EXPECT_EQ(result.p999_ns, 999);
  EXPECT_EQ(result.maximum_ns, 1000);
  EXPECT_EQ(session::quantiles(std::vector<std::int64_t>{7}).p999_ns, 7);
  EXPECT_EQ(session::quantiles(std::vector<std::int64_t>{}).count, 0U);
}

TEST(TimingVerdictTest, AQuietMachineIsGoodWithoutAdvice) {
  const TimingJudgement judgement = judge_timing(usual_plan(), quiet_record(), false);
  EXPECT_EQ(judgement.verdict, TimingVerdict::kGood);
  EXPECT_THAT(judgement.reasons, IsEmpty());
  EXPECT_THAT(judgement.advice, IsEmpty());
}

TEST(TimingVerdictTest, LateWakeUpsAndMissedTicksAreNamedWithAdvice) {
  TimingRecord record = quiet_record();
  std::fill_n(record.latency_ns.begin(), 20, 300 * kMicrosecondNs);
  TimingJudgement judgement = judge_timing(usual_plan(), record, false);
  EXPECT_EQ(judgement.verdict, TimingVerdict::kUsable);
  EXPECT_THAT(judgement.reasons, ElementsAre("one wake-up in 1000 is 300 us late or more"));
  EXPECT_EQ(judgement.advice.size(), 1U);
  std::fill_n(record.latency_ns.begin(), 20, 3 * kPeriodNs);
  record.missed_ticks = 40;
  record.status.advice = "allow your user 'rtprio 80'";
  judgement = judge_timing(usual_plan(), record, false);
  EXPECT_EQ(judgement.verdict, TimingVerdict::kPoor);
  EXPECT_EQ(judgement.reasons.back(), "40 of 10040 ticks were missed");
  EXPECT_THAT(judgement.advice, ElementsAre("allow your user 'rtprio 80'")) << "said once";
}

TEST(TimingVerdictTest, ADevicesLossesAgesAndWritesCount) {
  EXPECT_EQ(judge_timing(usual_plan(), quiet_device(), true).verdict, TimingVerdict::kGood);
  TimingRecord record = quiet_device();
  record.link.missing_states = 3;
  record.link.void_reports = 1;
  TimingJudgement judgement = judge_timing(usual_plan(), record, true);
  EXPECT_EQ(judgement.verdict, TimingVerdict::kUsable);
  EXPECT_THAT(judgement.reasons, ElementsAre("3 of 10004 reports are missing, 1 more are void"));
  record = quiet_device();
  std::fill_n(record.age_ns.begin(), 200, 4 * kPeriodNs);
  EXPECT_EQ(judge_timing(usual_plan(), record, true).verdict, TimingVerdict::kPoor);
  record = quiet_device();
  std::fill_n(record.write_ns.begin(), 200, kPeriodNs * 7 / 10);
  EXPECT_EQ(judge_timing(usual_plan(), record, true).verdict, TimingVerdict::kUsable);
  record = quiet_device();
  record.link.device_period_s = 0.5e-3;
  judgement = judge_timing(usual_plan(), record, true);
  EXPECT_THAT(judgement.advice.back(), HasSubstr("--set sampling.rate_hz=2000"));
}

TEST(TimingVerdictTest, TheDelayIsJudgedAndUnknownIsNotZero) {
  const auto judged = [](double delay_s) {
    TimingRecord record = quiet_device();
    record.link.delay_s = delay_s;
    return judge_timing(usual_plan(), record, true);
  };
  EXPECT_EQ(judged(2.01e-3).verdict, TimingVerdict::kGood);
  EXPECT_EQ(judged(2.1e-3).verdict, TimingVerdict::kUsable);
  EXPECT_EQ(judged(5.1e-3).verdict, TimingVerdict::kPoor);
  EXPECT_THAT(judged(5.1e-3).reasons.back(), HasSubstr("leaves 179 N/m"));
  EXPECT_THAT(judged(5.1e-3).reasons.back(), Not(HasSubstr("cannot be armed")));
  EXPECT_THAT(judged(0.051).reasons.back(), HasSubstr("cannot be armed"));
  EXPECT_EQ(judged(0.0).verdict, TimingVerdict::kPoor);
  EXPECT_THAT(judged(0.0).reasons.back(), HasSubstr("unknown"));
  TimingRecord record = quiet_device();
  record.link.delay_s = 0.0;
  EXPECT_THAT(timing_text(usual_plan(), record, "paddle"), HasSubstr("t_d: unknown"));
  const auto json = nlohmann::json::parse(timing_json(usual_plan(), record, "paddle"));
  EXPECT_TRUE(json["device"]["delay_s"].is_null());
}

// A wheel of the kernel at rest, heard every millisecond.
TEST(TimingVerdictTest, AWheelTellsNoDelayAndItsFileDoesWithADate) {
  TimingRecord record = quiet_device();
  record.link = {};
  record.link.connected = true;
  record.link.acknowledges = false;
  EXPECT_EQ(judge_timing(usual_plan(), record, true).verdict, TimingVerdict::kUsable);
  EXPECT_THAT(timing_text(usual_plan(), record, "wheel"), HasSubstr("t_d: unknown"));
  EXPECT_TRUE(
      nlohmann::json::parse(timing_json(usual_plan(), record, "wheel"))["device"]["delay_date"]
          .is_null());
  record.link.delay_s = 1.5e-3;
  record.delay_date = "2026-01-31";
  EXPECT_EQ(judge_timing(usual_plan(), record, true).verdict, TimingVerdict::kGood);
  EXPECT_THAT(timing_text(usual_plan(), record, "wheel"),
              HasSubstr("t_d: 1500 us, measured 2026-01-31"));
  EXPECT_EQ(
      nlohmann::json::parse(timing_json(usual_plan(), record, "wheel"))["device"]["delay_date"],
      "2026-01-31");
}

TEST(TimingReport, TextHasTableHistogramAndVerdict) {
  TimingRecord record = quiet_device();
  record.latency_ns[0] = 1500 * kMicrosecondNs;
  const std::string text = timing_text(usual_plan(), record, "Impulse Engine 2000");
  EXPECT_THAT(text, HasSubstr("Impulse Engine 2000 at 1000 Hz for 10 s: 10000 ticks, 0 missed"));
  EXPECT_THAT(text, HasSubstr("woken late             5.0       5.0       5.0    1500.0\n"));
  EXPECT_THAT(text, HasSubstr("round trip           600.0"));
  EXPECT_THAT(text, HasSubstr("t_d: 1000 us"));
  EXPECT_THAT(text, HasSubstr("     4 - 8             9999  ##################################"));
  EXPECT_THAT(text, HasSubstr("  1024 - 2048             1  #\n"));
  EXPECT_THAT(text, HasSubstr("verdict: good\n"));
  EXPECT_THAT(timing_text(usual_plan(), quiet_record(), ""), Not(HasSubstr("round trip")));
}

TEST(TimingReport, JsonHasTheSame) {
  const auto json = nlohmann::json::parse(timing_json(usual_plan(), quiet_device(), "paddle"));
  EXPECT_DOUBLE_EQ(json["latency"]["p99_s"], 5e-6);
  EXPECT_EQ(json["verdict"], "good");
  EXPECT_EQ(json["device"]["name"], "paddle");
  EXPECT_DOUBLE_EQ(json["device"]["round_trip"]["median_s"], 0.6e-3);
  EXPECT_TRUE(
      nlohmann::json::parse(timing_json(usual_plan(), quiet_record(), ""))["device"].is_null());
}

// Every second tick a position of the same state: nothing is counted twice.
class CountingDevice : public session::test::FakeDevice {
 public:
  [[nodiscard]] DeviceReading read() override {
    ++ticks;
    figures.connected = true;
    figures.states = static_cast<std::uint64_t>(ticks / 2);
    figures.round_trip_s = 1e-3;
    figures.write_time_s = 2e-6;
    figures.age_s = 3e-6;
    return FakeDevice::read();
  }
  int ticks = 0;
};

TEST(TimingProbe, WritesEveryTickDownAndNeverPushes) {
  CountingDevice device;
  session::test::FakeClock clock;
  clock.after_sleep = [](session::test::FakeClock& now) { now.advance_ns(7 * kMicrosecondNs); };
  const TimingRecord record =
      session::probe_timing({1000.0, 100, -1}, &device, clock, [](std::uint64_t) { return false; });
  EXPECT_EQ(record.latency_ns, std::vector<std::int64_t>(100, 7 * kMicrosecondNs));
  EXPECT_EQ(record.age_ns.size(), 100U);
  EXPECT_EQ(record.round_trip_ns, std::vector<std::int64_t>(50, kPeriodNs));
  EXPECT_EQ(record.write_ns, std::vector<std::int64_t>(50, 2 * kMicrosecondNs));
  EXPECT_EQ(record.link.states, 50U);
  EXPECT_EQ(device.forces_n, std::vector<double>(100, 0.0));
  EXPECT_FALSE(device.enabled);
}

TEST(TimingProbe, EndsWhenItIsAskedTo) {
  session::test::FakeClock clock;
  const TimingPlan plan{1000.0, 5'000'000, -1};
  clock.after_sleep = [](session::test::FakeClock&) { std::this_thread::yield(); };
  const TimingRecord record =
      session::probe_timing(plan, nullptr, clock, [](std::uint64_t done) { return done > 10; });
  EXPECT_GT(record.latency_ns.size(), 10U);
}

TEST_F(ProgramTest, TimingMeasuresThisMachine) {
  const Answer answer = hapticwall({"timing", "--seconds", "0.2", "--json", "-"});
  ASSERT_EQ(answer.status, 0) << answer.err;
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json["ticks"].get<int>(), 200);
  EXPECT_GT(json["latency"]["maximum_s"].get<double>(), 0.0);
  EXPECT_THAT(hapticwall({"timing", "--seconds", "0.05"}).out, HasSubstr("verdict: "));
}

TEST_F(ProgramTest, TimingThatIsEndedEarlySaysSo) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Answer answer =
        interrupted({"timing", "--seconds", "600", "--json", "a.json", "--quiet"}, signal);
    EXPECT_EQ(answer.status, 128 + signal);
    EXPECT_THAT(answer.err, HasSubstr("of 600000 ticks: the numbers cover these"));
    EXPECT_LT(nlohmann::json::parse(content("a.json"))["ticks"], 600'000);
    remove_files();
  }
}

}  // namespace
}  // namespace hapticwall::command::test
