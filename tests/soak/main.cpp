// hapticwall_soak real|virtual HOURS: a session used for hours, by the machine's own clock or by
// one whose hours pass in seconds. A line now and then; status 1 where anything was lost, where
// memory has grown, or where the deadlines have left their grid.
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/session/live_session.h"
#include "app/session/loop/latency_histogram.h"
#include "tests/app/session/support.h"
#include "tests/soak/researcher.h"
#include "tests/soak/watched_clock.h"

namespace hapticwall::soak {
namespace {

// Periods of this rate are no whole number of nanoseconds: rounding errors that add up would show.
constexpr double kRateHz = 1100.0;
constexpr std::int64_t kTurnNs = 1'000'000'000 / 60;
constexpr std::uint64_t kTurnsAnHour = 216'000;
constexpr int kLines = 12;
constexpr std::uint64_t kSeed = 1;

constexpr double kMaxPhaseNs = 1.0;  // a deadline is a whole number of nanoseconds
constexpr double kMaxGrowthMb = 0.5;
constexpr double kBytesInMb = 1e6;
constexpr double kNanosecondsInMicrosecond = 1e3;

struct Memory {
  double resident_mb = 0.0;
  double allocated_mb = 0.0;
};

Memory memory() {
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return {static_cast<double>(pages * sysconf(_SC_PAGESIZE)) / kBytesInMb,
          static_cast<double>(mallinfo2().uordblks) / kBytesInMb};
}

// Memory of a session that has just been reset, and keeps nothing of the time before. Sometimes a
// recording has just ended, and a thread frees its buffers a moment later: the minimum over some
// resets counts.
class MemoryAtRest {
 public:
  void take() { taken_.push_back(memory()); }
  // Minimum over the first half of the resets, and over the second.
  [[nodiscard]] Memory first() const { return least(0, taken_.size() / 2); }
  [[nodiscard]] Memory second() const { return least(taken_.size() / 2, taken_.size()); }
  [[nodiscard]] double growth_mb() const { return second().allocated_mb - first().allocated_mb; }

 private:
  [[nodiscard]] Memory least(std::size_t begin, std::size_t end) const {
    Memory least;
    for (std::size_t i = begin; i < end; ++i) {
      if (i == begin || taken_[i].allocated_mb < least.allocated_mb) least = taken_[i];
    }
    return least;
  }
  std::vector<Memory> taken_;
};

// Every period was a cycle or is counted as missed or rested, from the first deadline to now.
bool every_period_is_accounted_for(session::LiveSession& session, const WatchedClock& clock) {
  constexpr int kTries = 1000;  // the loop goes on while we look
  auto timing = std::make_unique<session::TimingHistograms>();
  for (int i = 0; i < kTries; ++i) {
    const std::uint64_t periods = clock.periods();
    session.read_timing(*timing);
    const session::TimingStatistics left_out = session.snapshot().timing;
    if (timing->wake_latency.total() + left_out.missed_ticks + left_out.rested_periods == periods &&
        clock.periods() == periods)
      return true;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return false;
}

void print_line(std::uint64_t turn, session::LiveSession& session, const WatchedClock& clock,
                const Tally& tally) {
  auto timing = std::make_unique<session::TimingHistograms>();
  session.read_timing(*timing);
  const Memory now = memory();
  std::printf("%7.2f %11llu %9llu %10.1f %9llu %6llu %5llu %9llu %8.2f %8.1f %7.2f\n",
              static_cast<double>(turn) / kTurnsAnHour,
              static_cast<unsigned long long>(timing->wake_latency.total()),
              static_cast<unsigned long long>(session.snapshot().timing.missed_ticks),
              static_cast<double>(session::quantiles(timing->wake_latency).p99_ns) /
                  kNanosecondsInMicrosecond,
              static_cast<unsigned long long>(tally.changes),
              static_cast<unsigned long long>(tally.resets),
              static_cast<unsigned long long>(tally.recordings),
              static_cast<unsigned long long>(tally.rows), now.allocated_mb, now.resident_mb,
              clock.worst_phase_ns());
  std::fflush(stdout);
}

int verdict(const Tally& tally, const MemoryAtRest& rest, const WatchedClock& clock,
            bool accounted) {
  int wrong = 0;
  const auto judge = [&](bool good, const std::string& what) {
    std::printf("%s %s\n", good ? "ok    " : "FAILED", what.c_str());
    if (!good) ++wrong;
  };
  judge(tally.trouble.empty(), tally.trouble.empty()
                                   ? "no sample and no row lost, no force over the limit"
                                   : tally.trouble);
  judge(accounted, "every period is a cycle or counted as missed or rested");
  judge(clock.worst_phase_ns() <= kMaxPhaseNs,
        "no deadline further from its grid than " + std::to_string(clock.worst_phase_ns()) + " ns");
  judge(rest.growth_mb() <= kMaxGrowthMb,
        "memory after a reset, the least in the first half and in the second: " +
            std::to_string(rest.first().allocated_mb) + " and " +
            std::to_string(rest.second().allocated_mb) + " MB, resident " +
            std::to_string(rest.first().resident_mb) + " and " +
            std::to_string(rest.second().resident_mb) + " MB");
  judge(tally.contacts > 0 && tally.recordings > 0 && tally.resets > 1 && tally.changes > 0,
        std::to_string(tally.contacts) + " ticks in contact, " + std::to_string(tally.recordings) +
            " recordings, " + std::to_string(tally.changes) + " changes, " +
            std::to_string(tally.resets) + " resets");
  return wrong == 0 ? 0 : 1;
}

int soak(WatchedClock& clock, double hours) {
  session::SessionOptions options;
  options.clock = &clock;
  auto started = session::LiveSession::start(pressing_scene(kRateHz), options);
  if (!started) throw std::runtime_error(started.error().message);
  session::LiveSession& session = **started;
  const session::test::TemporaryFolder folder;
  Researcher researcher(session, folder.file("soak.csv"), kSeed);
  MemoryAtRest rest;
  std::printf("%s\n%7s %11s %9s %10s %9s %6s %5s %9s %8s %8s %7s\n",
              session.realtime_status().text.c_str(), "hours", "cycles", "missed", "p99 us",
              "changes", "resets", "files", "rows", "heap MB", "RSS MB", "grid ns");
  const auto turns = static_cast<std::uint64_t>(hours * static_cast<double>(kTurnsAnHour));
  const std::uint64_t line = std::max<std::uint64_t>(1, turns / kLines);
  for (std::uint64_t turn = 1; turn <= turns; ++turn) {
    clock.pass(kTurnNs);
    researcher.turn([&] { rest.take(); });
    if (turn % line == 0) print_line(turn, session, clock, researcher.tally());
  }
  researcher.leave();
  const bool accounted = every_period_is_accounted_for(session, clock);
  return verdict(researcher.tally(), rest, clock, accounted);
}

int run(std::string_view kind, double hours) {
  if (kind == "real") {
    RealClock clock(kRateHz);
    return soak(clock, hours);
  }
  VirtualClock clock(kRateHz);
  return soak(clock, hours);
}

}  // namespace
}  // namespace hapticwall::soak

int main(int argc, char** argv) {
  const std::string_view kind = argc == 3 ? argv[1] : "";
  const double hours = argc == 3 ? std::strtod(argv[2], nullptr) : 0.0;
  if ((kind != "real" && kind != "virtual") || !(hours > 0.0)) {
    std::fprintf(stderr, "usage: hapticwall_soak real|virtual HOURS\n");
    return 2;
  }
  try {
    return hapticwall::soak::run(kind, hours);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "error: %s\n", problem.what());
    return 2;
  }
}
