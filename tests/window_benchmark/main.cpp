// Measures the window: `frames`, or `loop [SECONDS [BLOCK_SECONDS]]`.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/window_benchmark/measurements.h"

namespace {

constexpr double kSeconds = 600.0;
constexpr double kBlockSeconds = 10.0;

int usage() {
  std::fputs("usage: hapticwall_window_benchmark frames | loop [SECONDS [BLOCK_SECONDS]]\n",
             stderr);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "frames") return hapticwall::window_benchmark::measure_frames();
  if (what != "loop") return usage();
  const double seconds = argc > 2 ? std::atof(argv[2]) : kSeconds;
  const double block_s = argc > 3 ? std::atof(argv[3]) : kBlockSeconds;
  if (!(seconds > 0.0 && block_s > 0.0)) return usage();
  return hapticwall::window_benchmark::measure_loop(seconds, block_s);
}
