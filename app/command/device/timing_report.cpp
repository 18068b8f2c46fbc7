#include "app/command/device/timing_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "app/session/loop/device_judge.h"
#include "app/table/json_report.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

using session::Measure;
using session::Quantiles;
using session::TimingPlan;
using session::TimingRecord;

constexpr std::size_t kHistogramWidth = 50;
constexpr double kRateTolerance = 0.01;

struct DeviceMarks {
  double age;             // age limit in periods
  double write;           // write limit in periods
  double missing_states;  // share of all
  double delay;           // delay limit in periods
};
constexpr DeviceMarks kGoodMarks{1.5, 0.5, 0.0, 2.0};
constexpr DeviceMarks kUsableMarks{3.0, 1.0, 1e-3, session::kUsableDelayTicks};

double microseconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / kNanosecondsPerMicrosecond;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Stiffness limit of a wall without algorithm, N/m for each N s/m of the device's damping: 1 / (T/2
// + t_d).
double stiffness_left(const TimingPlan& plan, double delay_s) {
  return 1.0 / (0.5 / plan.rate_hz + delay_s);
}

// The mean decides: a single slow command disarms at most.
void judge_delay(const TimingPlan& plan, const device::LinkStats& link,
                 TimingJudgement& judgement) {
  const std::string advice = "give the device a USB port of its own";
  if (link.delay_s <= 0.0 && !link.acknowledges) {
    judge(Measure{1.0, 0.0, 1.0, "the delay is unknown: a wheel acknowledges nothing",
                  "state a measured one in its device file (docs/wheels.md)"},
          judgement);
    return;
  }
  if (link.delay_s <= 0.0) {
    judge(Measure{1.0, 0.0, 0.0,
                  "the delay is unknown: the device acknowledged no command; the force cannot be "
                  "armed",
                  "its firmware has to follow docs/hid-protocol.md"},
          judgement);
    return;
  }
  const double period_s = 1.0 / plan.rate_hz;
  std::string reason = fmt::format(
      "a force acts {:.0f} us after its position: this leaves {:.0f} N/m without an algorithm for "
      "each N s/m of damping",
      link.delay_s * kMicrosecondsPerSecond, stiffness_left(plan, link.delay_s));
  if (link.delay_s > session::kMaxCommandAgeS) reason += "; the force cannot be armed";
  judge(Measure{link.delay_s, session::kDelayTolerance * kGoodMarks.delay * period_s,
                session::kDelayTolerance * kUsableMarks.delay * period_s, reason, advice},
        judgement);
}

void judge_device(const TimingPlan& plan, const TimingRecord& record, TimingJudgement& judgement) {
  const double period_ns = kNanosecondsPerSecond / plan.rate_hz;
  const device::LinkStats& link = record.link;
  const std::uint64_t lost = link.missing_states + link.void_reports;
  judge(Measure{share(lost, link.states + lost), kGoodMarks.missing_states,
                kUsableMarks.missing_states,
                fmt::format("{} of {} reports are missing, {} more are void", link.missing_states,
                            link.states + lost, link.void_reports),
                "plug the device into the machine without a hub, and try another cable"},
        judgement);
  const Quantiles age = session::quantiles(record.age_ns);
  judge(
      Measure{
          static_cast<double>(age.p99_ns), kGoodMarks.age * period_ns, kUsableMarks.age * period_ns,
          fmt::format("one position in 100 is at least {:.0f} us old", microseconds(age.p99_ns)),
          "give the device a USB port of its own"},
      judgement);
  const Quantiles write = session::quantiles(record.write_ns);
  judge(
      Measure{static_cast<double>(write.p99_ns), kGoodMarks.write * period_ns,
              kUsableMarks.write * period_ns,
              fmt::format("one write in 100 takes at least {:.0f} us", microseconds(write.p99_ns)),
              "give the device a USB port of its own"},
      judgement);
  judge_delay(plan, link, judgement);
  if (link.device_period_s <= 0.0) return;
  const double device_rate_hz = 1.0 / link.device_period_s;
  if (std::abs(device_rate_hz / plan.rate_hz - 1.0) > kRateTolerance) {
    judgement.verdict = std::max(judgement.verdict, TimingVerdict::kUsable);
    judgement.reasons.push_back(fmt::format("the device ticks at {:.1f} Hz, the loop at {:g} Hz",
                                            device_rate_hz, plan.rate_hz));
    judgement.advice.push_back(fmt::format(
        "run scenes at the device's rate: --set sampling.rate_hz={:.0f}", device_rate_hz));
  }
}

std::string quantile_row(std::string_view name, const std::vector<std::int64_t>& values_ns) {
  const Quantiles row = session::quantiles(values_ns);
  if (row.count == 0) return fmt::format("{:<16}{:>10}\n", name, "-");
  return fmt::format("{:<16}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}\n", name,
                     microseconds(row.median_ns), microseconds(row.p99_ns),
                     microseconds(row.p999_ns), microseconds(row.maximum_ns));
}

// Bin 0 is below a microsecond, bin n from 2^(n-1) to 2^n microseconds.
std::string histogram(const std::vector<std::int64_t>& values_ns) {
  std::vector<std::size_t> bins;
  for (const std::int64_t value_ns : values_ns) {
    const auto whole_us = static_cast<std::uint64_t>(std::max<std::int64_t>(value_ns, 0)) / 1000;
    const auto bin = static_cast<std::size_t>(std::bit_width(whole_us));
    if (bin >= bins.size()) bins.resize(bin + 1);
    ++bins[bin];
  }
  const std::size_t max = bins.empty() ? 1 : *std::max_element(bins.begin(), bins.end());
  std::string text = "\nwoken late, us        ticks\n";
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    const std::size_t from = bin == 0 ? 0 : std::size_t{1} << (bin - 1);
    // Rounded up: a bin with ticks shows a bar.
    const std::size_t length = (bins[bin] * kHistogramWidth + max - 1) / max;
    text += fmt::format("{:>6} - {:<6}{:>12}  {:#<{}}\n", from, std::size_t{1} << bin, bins[bin],
                        "", length);
  }
  return text;
}

std::string wheel_text(const TimingRecord& record) {
  const device::LinkStats& link = record.link;
  const std::string delay =
      link.delay_s > 0.0 ? fmt::format("{:.0f} us, measured {} (its device file)",
                                       link.delay_s * kMicrosecondsPerSecond, record.delay_date)
                         : "unknown";
  return fmt::format(
      "\n{} changes of position; a wheel acknowledges nothing: reports that are missing, and "
      "commands, are unknown; link lost {} times\nfrom a position to its force, t_d: {}\n",
      link.states, link.losses, delay);
}

std::string link_text(const TimingRecord& record) {
  const device::LinkStats& link = record.link;
  if (!link.acknowledges) return wheel_text(record);
  std::string text = fmt::format(
      "\n{} states, {} missing, {} void, {} repeated; {} commands rejected; link lost {} times\n",
      link.states, link.missing_states, link.void_reports, link.repeated_states,
      link.rejected_commands, link.losses);
  if (link.device_period_s > 0.0) {
    text += fmt::format("the device's own rate: {:.2f} Hz\n", 1.0 / link.device_period_s);
  }
  if (link.delay_s > 0.0) {
    text += fmt::format(
        "from a position to its force, t_d: {:.0f} us, max {:.0f} us (by the device's clock)\n",
        link.delay_s * kMicrosecondsPerSecond, link.maximum_delay_s * kMicrosecondsPerSecond);
  } else {
    text += "from a position to its force, t_d: unknown\n";
  }
  return text;
}

table::Json quantiles_object(const std::vector<std::int64_t>& values_ns) {
  const Quantiles row = session::quantiles(values_ns);
  if (row.count == 0) return nullptr;
  const auto seconds = [](std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) / kNanosecondsPerSecond;
  };
  return {{"count", row.count},
          {"median_s", seconds(row.median_ns)},
          {"p99_s", seconds(row.p99_ns)},
          {"p999_s", seconds(row.p999_ns)},
          {"maximum_s", seconds(row.maximum_ns)}};
}

table::Json device_object(const TimingRecord& record, const std::string& device_name) {
  const device::LinkStats& link = record.link;
  const auto told = [&](auto value) {
    return link.acknowledges ? table::Json(value) : table::Json();
  };
  const table::Json date =
      record.delay_date.empty() ? table::Json() : table::Json(record.delay_date);
  return {{"name", device_name},
          {"states", link.states},
          {"missing_states", told(link.missing_states)},
          {"void_reports", told(link.void_reports)},
          {"repeated_states", told(link.repeated_states)},
          {"rejected_commands", told(link.rejected_commands)},
          {"losses", link.losses},
          {"device_period_s", told(link.device_period_s)},
          {"delay_s", link.delay_s > 0.0 ? table::Json(link.delay_s) : table::Json()},
          {"delay_date", date},
          {"age", quantiles_object(record.age_ns)},
          {"round_trip", quantiles_object(record.round_trip_ns)},
          {"write", quantiles_object(record.write_ns)}};
}

}  // namespace

TimingJudgement judge_timing(const TimingPlan& plan, const TimingRecord& record, bool has_device) {
  TimingJudgement judgement;
  session::judge(session::LoopTiming{plan.rate_hz, session::quantiles(record.latency_ns),
                                     record.missed_ticks, record.status.advice},
                 judgement);
  if (has_device) judge_device(plan, record, judgement);
  return judgement;
}

std::string timing_text(const TimingPlan& plan, const TimingRecord& record,
                        const std::string& device_name) {
  const std::size_t ticks = record.latency_ns.size();
  std::string text = fmt::format("{} at {:g} Hz for {:.4g} s: {} ticks, {} missed\n{}\n\n",
                                 device_name.empty() ? "the loop" : device_name, plan.rate_hz,
                                 static_cast<double>(ticks + record.missed_ticks) / plan.rate_hz,
                                 ticks, record.missed_ticks, record.status.text);
  if (plan.spin_s > 0.0) {
    text.resize(text.size() - 1);
    text += fmt::format(
        "busy waiting for the last {:.0f} us before a tick; the loop takes {:.1f} % of a core\n\n",
        plan.spin_s * kMicrosecondsPerSecond, kPercent * record.processor_share);
  }
  text += fmt::format("{:<16}{:>10}{:>10}{:>10}{:>10}\n", "us", "median", "p99", "p99.9", "max");
  text += quantile_row("woken late", record.latency_ns);
  text += quantile_row("a tick's work", record.compute_ns);
  if (!device_name.empty()) {
    text += quantile_row("position's age", record.age_ns);
    text += quantile_row("round trip", record.round_trip_ns);
    text += quantile_row("write", record.write_ns);
    text += link_text(record);
  }
  text += histogram(record.latency_ns);
  const TimingJudgement judgement = judge_timing(plan, record, !device_name.empty());
  text += fmt::format("\nverdict: {}\n", timing_verdict_name(judgement.verdict));
  for (const std::string& reason : judgement.reasons) text += "  because " + reason + "\n";
  for (const std::string& advice : judgement.advice) text += "  advice: " + advice + "\n";
  return text;
}

std::string timing_json(const TimingPlan& plan, const TimingRecord& record,
                        const std::string& device_name) {
  const TimingJudgement judgement = judge_timing(plan, record, !device_name.empty());
  const table::Json object = {
      {"rate_hz", plan.rate_hz},
      {"ticks", record.latency_ns.size()},
      {"missed_ticks", record.missed_ticks},
      {"realtime", record.status.text},
      {"spin_s", plan.spin_s},
      {"processor_share", record.processor_share},
      {"verdict", timing_verdict_name(judgement.verdict)},
      {"reasons", judgement.reasons},
      {"advice", judgement.advice},
      {"latency", quantiles_object(record.latency_ns)},
      {"compute", quantiles_object(record.compute_ns)},
      {"device", device_name.empty() ? table::Json() : device_object(record, device_name)}};
  return table::json_text(object);
}

}  // namespace hapticwall::command
