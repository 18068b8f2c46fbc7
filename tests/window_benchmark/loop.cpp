#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/file/recording/recording_reader.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/window/application.h"
#include "core/algorithm/algorithm.h"
#include "tests/app/session/support.h"
#include "tests/app/ui/show_everything.h"
#include "tests/window_benchmark/blocks.h"
#include "tests/window_benchmark/measurements.h"
#include "tests/window_benchmark/stage.h"

namespace hapticwall::window_benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kHogs = 2;
constexpr double kWarmUpS = 3.0;
constexpr double kMaxRatio = 1.2;
constexpr double kLoopRateHz = 1000.0;
// How often a window that nobody sees takes its samples.
constexpr std::chrono::milliseconds kUnseenFrame{100};

// Processes that do nothing but keep the cores busy, while this lives. To be made before any
// thread is.
class Hogs {
 public:
  explicit Hogs(int count) {
    for (int i = 0; i < count; ++i) {
      const pid_t child = fork();
      if (child == 0) burn();
      if (child > 0) children_.push_back(child);
    }
  }
  Hogs(const Hogs&) = delete;
  Hogs& operator=(const Hogs&) = delete;
  ~Hogs() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }

 private:
  [[noreturn]] static void burn() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (volatile unsigned turns = 0;;) turns = turns + 1;
  }
  std::vector<pid_t> children_;
};

// Seconds, of all cores together, that a virtual machine's host gave to somebody else since it
// started; 0 where the kernel does not say.
double stolen_s() {
  std::ifstream file("/proc/stat");
  std::string name;
  double ticks = 0.0;
  constexpr int kStolenColumn = 8;
  file >> name;
  for (int column = 0; column < kStolenColumn; ++column) file >> ticks;
  return file ? ticks / static_cast<double>(sysconf(_SC_CLK_TCK)) : 0.0;
}

void draw_once(ui::Application& application, Stage& stage) {
  static_cast<void>(stage.frame([&] { application.frame(); }));
}

void run_block(ui::Application& application, Stage& stage, bool drawn, double seconds,
               Blocks& blocks) {
  session::TimingHistograms before;
  application.live()->read_timing(before);
  const std::uint64_t missed = application.session().snapshot().timing.missed_ticks;
  const double stolen_before_s = stolen_s();
  const auto start = Clock::now();
  const auto passed_s = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  while (passed_s() < seconds) {
    if (drawn) {
      draw_once(application, stage);
      ++blocks.frames;
    } else {
      application.take_ticks();
      std::this_thread::sleep_for(kUnseenFrame);
    }
  }
  blocks.seconds += passed_s();
  blocks.stolen_s += stolen_s() - stolen_before_s;
  session::TimingHistograms after;
  application.live()->read_timing(after);
  const session::LatencyCounts latencies = after.wake_latency.since(before.wake_latency);
  blocks.timing.wake_latency += latencies;
  blocks.p99_ns.push_back(session::quantiles(latencies).p99_ns);
  blocks.timing.compute_time += after.compute_time.since(before.compute_time);
  blocks.missed_ticks += application.session().snapshot().timing.missed_ticks - missed;
}

void print_table(const Blocks& without, const Blocks& with) {
  print_heading();
  for (const Blocks* blocks : {&without, &with}) {
    print_row(*blocks, "wake-up", blocks->timing.wake_latency);
    print_row(*blocks, "compute", blocks->timing.compute_time);
  }
  const session::Quantiles a = session::quantiles(without.timing.wake_latency);
  const session::Quantiles b = session::quantiles(with.timing.wake_latency);
  std::printf(
      "wake-up, with to without: median %.2fx, p99 %.2fx (at most %.1fx is wanted), p99.9 %.2fx, "
      "most %.2fx\n",
      ratio(b.median_ns, a.median_ns), ratio(b.p99_ns, a.p99_ns), kMaxRatio,
      ratio(b.p999_ns, a.p999_ns), ratio(b.maximum_ns, a.maximum_ns));
  print_spread(without);
  print_spread(with);
  std::printf("the usual block's p99, with to without: %.2fx\n",
              ratio(p99_at(with, 2), p99_at(without, 2)));
  std::printf("%llu frames, %.1f a second\n", static_cast<unsigned long long>(with.frames),
              static_cast<double>(with.frames) / with.seconds);
}

// Ticks that are missing between the first and the last of so many.
std::uint64_t gaps(double first_tick, double last_tick, std::uint64_t count) {
  return static_cast<std::uint64_t>(last_tick - first_tick) + 1 - count;
}

// Samples lost on the way to the plots and to the disk; 0 if everything arrived.
Result<std::uint64_t> print_losses(ui::Application& application, const std::string& csv) {
  session::LiveSession& session = *application.live();
  session.pause(true);
  while (!session.snapshot().paused) std::this_thread::sleep_for(kUnseenFrame);
  application.take_ticks();
  const draw::SampleHistory& history = application.history();
  const std::uint64_t plot_gaps =
      gaps(history.value(&Sample::tick, 0), history.value(&Sample::tick, history.size() - 1),
           history.size());
  const std::uint64_t plot_drops = session.dropped_plot_samples();
  if (Failure failure = session.stop_recording()) return *failure;
  const std::uint64_t row_drops = session.recording_status().dropped_rows;
  const auto recording = file::RecordingReader::open(csv);
  if (!recording) return recording.error();
  const file::ScannedRows& rows = (*recording)->info().scanned;
  const std::uint64_t row_gaps =
      gaps(static_cast<double>(rows.first_tick), static_cast<double>(rows.last_tick), rows.rows);
  std::printf(
      "lost: %llu of %zu samples on the way to the plots (%llu ticks missing), %llu of %llu rows "
      "of "
      "the recording (%llu ticks missing)\n",
      static_cast<unsigned long long>(plot_drops), history.size(),
      static_cast<unsigned long long>(plot_gaps), static_cast<unsigned long long>(row_drops),
      static_cast<unsigned long long>(rows.rows), static_cast<unsigned long long>(row_gaps));
  return plot_drops + plot_gaps + row_drops + row_gaps;
}

// Off, on, on, off: what changes slowly on the machine hits both alike.
void alternate(double seconds, double block_s, const std::function<void(bool on)>& run) {
  constexpr bool kOn[] = {false, true, true, false};
  const int blocks = std::max(2, static_cast<int>(seconds / block_s));
  for (int block = 0; block < blocks; ++block) run(kOn[block % 4]);
}

void compare(ui::Application& application, Stage& stage, double seconds, double block_s) {
  Blocks without{"without window", {}, 0, 0, 0.0, 0.0, {}};
  Blocks with{"with window", {}, 0, 0, 0.0, 0.0, {}};
  alternate(seconds, block_s, [&](bool drawn) {
    run_block(application, stage, drawn, block_s, drawn ? with : without);
  });
  print_table(without, with);
}

// The map is of all algorithms: no block sees its end.
void compare_map(ui::Application& application, Stage& stage, double seconds, double block_s) {
  Blocks without{"without map", {}, 0, 0, 0.0, 0.0, {}};
  Blocks with{"with map", {}, 0, 0, 0.0, 0.0, {}};
  ui::UiState& state = application.state();
  for (std::size_t i = 0; i < algorithms().size(); ++i)
    ui::choose_algorithm_in_map(state.map.choice, i, true);
  alternate(seconds, block_s, [&](bool map) {
    ui::show_page(state.dock, map ? "Map" : "Timing");
    run_block(application, stage, true, block_s, map ? with : without);
  });
  print_table(without, with);
}

void draw_throughout(ui::Application& application, Stage& stage, double seconds) {
  Blocks with{"with window", {}, 0, 0, 0.0, 0.0, {}};
  run_block(application, stage, true, seconds, with);
  print_heading();
  print_row(with, "wake-up", with.timing.wake_latency);
  print_row(with, "compute", with.timing.compute_time);
  std::printf("%llu frames, %.1f a second\n", static_cast<unsigned long long>(with.frames),
              static_cast<double>(with.frames) / with.seconds);
}

// Runs `measure` during a recording; returns how much of the recording was lost.
Result<std::uint64_t> run(Stage& stage, const Scene& scene,
                          const std::function<void(ui::Application&)>& measure) {
  const session::test::TemporaryFolder folder;
  const std::string csv = folder.file("loop.csv");
  ui::Application::Sessions sessions;
  sessions.simulate = [](const Scene& wanted, BorrowedAlgorithm*) {
    return session::LiveSession::start(wanted);
  };
  auto created = ui::Application::create(scene, {}, stage.theme(), sessions);
  if (!created) return created.error();
  ui::Application& application = **created;
  test::show_everything(application.state());
  std::printf("The loop of '%s' at %g Hz, %s\n%dx%d by %s\n", scene.name.c_str(),
              scene.sampling.rate_hz, application.session().realtime_status().text.c_str(), kWidth,
              kHeight, stage.renderer().c_str());
  std::fflush(stdout);
  Blocks warm_up{"", {}, 0, 0, 0.0, 0.0, {}};
  run_block(application, stage, true, kWarmUpS, warm_up);
  if (Failure failure = application.live()->start_recording(csv)) return *failure;
  measure(application);
  return print_losses(application, csv);
}

// `hogs`: processes that keep the cores busy. Returns the exit status of the program.
int run_at(double rate_hz, int hogs, const std::function<void(ui::Application&, Stage&)>& measure) {
  std::printf("Beside %d busy processes\n", hogs);
  std::fflush(stdout);
  const Hogs busy(hogs);
  const auto fail = [](const Error& error) {
    std::fprintf(stderr, "%s\n", error.message.c_str());
    return EXIT_FAILURE;
  };
  auto loaded = file::load_scene("press");
  if (!loaded) return fail(loaded.error());
  loaded->scene.sampling.rate_hz = rate_hz;
  const auto stage = Stage::create(kWidth, kHeight);
  if (!stage) return fail(stage.error());
  const Result<std::uint64_t> lost = run(
      **stage, loaded->scene, [&](ui::Application& application) { measure(application, **stage); });
  if (!lost) return fail(lost.error());
  return *lost == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int measure_loop(double seconds, double block_s) {
  return run_at(kLoopRateHz, kHogs, [&](ui::Application& application, Stage& stage) {
    compare(application, stage, seconds, block_s);
  });
}

int measure_map_loop(double seconds, double block_s) {
  return run_at(kLoopRateHz, 0, [&](ui::Application& application, Stage& stage) {
    compare_map(application, stage, seconds, block_s);
  });
}

int measure_recording(double seconds, double rate_hz) {
  return run_at(rate_hz, kHogs, [&](ui::Application& application, Stage& stage) {
    draw_throughout(application, stage, seconds);
  });
}

}  // namespace hapticwall::window_benchmark
