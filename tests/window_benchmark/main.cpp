// Measures the window: `frames`, `map`, `loop [SECONDS [BLOCK_SECONDS]]`, `map-loop` and `stream`
// with the same, or `record [SECONDS [RATE_HZ]]`.
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
      "usage: hapticwall_window_benchmark frames | map | loop [SECONDS [BLOCK_SECONDS]] | "
      "map-loop [SECONDS [BLOCK_SECONDS]] | stream [SECONDS [BLOCK_SECONDS]] | record [SECONDS "
      "[RATE_HZ]]\n",
      stderr);
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  namespace measures = hapticwall::window_benchmark;
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "frames") return measures::measure_frames();
  if (what == "map") return measures::measure_map();
  if (what != "loop" && what != "map-loop" && what != "stream" && what != "record") return usage();
  const double seconds = argc > 2 ? std::atof(argv[2]) : kSeconds;
  const double more = argc > 3           ? std::atof(argv[3])
                      : what == "record" ? kRecordedRateHz
                                         : kBlockSeconds;
  if (!(seconds > 0.0 && more > 0.0)) return usage();
  if (what == "record") return measures::measure_recording(seconds, more);
  if (what == "stream") return measures::measure_stream(seconds, more);
  if (what == "loop") return measures::measure_loop(seconds, more);
  return measures::measure_map_loop(seconds, more);
}
