#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>

#include "app/file/scene/scene_file.h"
#include "app/session/live_session.h"
#include "tests/app/file/stream_support.h"
#include "tests/app/session/support.h"
#include "tests/window_benchmark/blocks.h"
#include "tests/window_benchmark/measurements.h"

namespace hapticwall::window_benchmark {
namespace {

using file::test::StreamReader;

enum class Reader { kNoStream, kReads, kStalls };

struct Kind {
  Reader reader;
  Blocks blocks;
  std::uint64_t rows = 0;
  std::uint64_t lost_rows = 0;
};

void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// Throws what cannot be started.
std::unique_ptr<session::LiveSession> started(const Scene& scene, const StreamReader& reader,
                                              bool streams) {
  session::SessionOptions options;
  if (streams) options.stream = file::test::opened_stream(reader.path());
  auto session = session::LiveSession::start(scene, options);
  if (!session) throw std::runtime_error(session.error().message);
  return std::move(*session);
}

void measure_block(session::LiveSession& session, double seconds, Blocks& blocks) {
  constexpr double kSettleS = 1.0;
  sleep_s(kSettleS);
  session::TimingHistograms before;
  session.read_timing(before);
  const std::uint64_t missed = session.snapshot().timing.missed_ticks;
  sleep_s(seconds);
  session::TimingHistograms after;
  session.read_timing(after);
  const session::LatencyCounts latencies = after.wake_latency.since(before.wake_latency);
  blocks.timing.wake_latency += latencies;
  blocks.timing.compute_time += after.compute_time.since(before.compute_time);
  blocks.p99_ns.push_back(session::quantiles(latencies).p99_ns);
  blocks.missed_ticks += session.snapshot().timing.missed_ticks - missed;
}

void run_block(const Scene& scene, double seconds, Kind& kind) {
  const session::test::TemporaryFolder folder;
  StreamReader reader(folder.file("pipe"));
  const auto session = started(scene, reader, kind.reader != Reader::kNoStream);
  if (Failure failure = session->start_recording(folder.file("a.csv")))
    throw std::runtime_error(failure->message);
  {
    const std::jthread reading([&](const std::stop_token& stop) {
      while (kind.reader == Reader::kReads && !stop.stop_requested()) {
        if (!reader.read_some()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
    measure_block(*session, seconds, kind.blocks);
  }
  if (Failure failure = session->stop_recording()) throw std::runtime_error(failure->message);
  kind.rows += session->recording_status().rows;
  kind.lost_rows += session->recording_status().dropped_rows;
}

void print(const std::vector<Kind>& kinds) {
  print_heading();
  for (const Kind& kind : kinds) {
    print_row(kind.blocks, "wake-up", kind.blocks.timing.wake_latency);
    print_row(kind.blocks, "compute", kind.blocks.timing.compute_time);
  }
  for (const Kind& kind : kinds) {
    std::printf(
        "%-16sthe usual block's p99 %.2fx of that without a stream; %llu of %llu rows lost\n",
        kind.blocks.name, ratio(p99_at(kind.blocks, 2), p99_at(kinds.front().blocks, 2)),
        static_cast<unsigned long long>(kind.lost_rows),
        static_cast<unsigned long long>(kind.rows) + kind.lost_rows);
    print_spread(kind.blocks);
  }
}

}  // namespace

int measure_stream(double seconds, double block_s) try {
  const auto loaded = file::load_scene("press");
  if (!loaded) throw std::runtime_error(loaded.error().message);
  std::vector<Kind> kinds{{Reader::kNoStream, {"no stream", {}, 0, 0, 0.0, 0.0, {}}},
                          {Reader::kReads, {"a reader", {}, 0, 0, 0.0, 0.0, {}}},
                          {Reader::kStalls, {"reader stalled", {}, 0, 0, 0.0, 0.0, {}}}};
  const auto start = std::chrono::steady_clock::now();
  do {
    for (Kind& kind : kinds) run_block(loaded->scene, block_s, kind);
  } while (std::chrono::steady_clock::now() - start < std::chrono::duration<double>(seconds));
  print(kinds);
  return kinds[0].lost_rows + kinds[1].lost_rows + kinds[2].lost_rows == 0 ? EXIT_SUCCESS
                                                                           : EXIT_FAILURE;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return EXIT_FAILURE;
}

}  // namespace hapticwall::window_benchmark
