// Measures the window: `frames`, `loop [SECONDS [BLOCK_SECONDS]]`, or `record [SECONDS [RATE_HZ]]`.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/window_benchmark/measurements.h"

namespace {

constexpr double kSeconds = 600.0;
constexpr double kBlockSeconds = 10.0;
constexpr double kRecordedRateHz = 10'000.0;

int usage() {
  std::fputs(
      "usage: hapticwall_window_benchmark frames | loop [SECONDS [BLOCK_SECONDS]] | "
      "record [SECONDS [RATE_HZ]]\n",
      stderr);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "frames") return hapticwall::window_benchmark::measure_frames();
  if (what != "loop" && what != "record") return usage();
  const bool compared = what == "loop";
  const double seconds = argc > 2 ? std::atof(argv[2]) : kSeconds;
  const double more = argc > 3 ? std::atof(argv[3]) : compared ? kBlockSeconds : kRecordedRateHz;
  if (!(seconds > 0.0 && more > 0.0)) return usage();
  return compared ? hapticwall::window_benchmark::measure_loop(seconds, more)
                  : hapticwall::window_benchmark::measure_recording(seconds, more);
}
