#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <thread>

#include "app/file/scene/scene_file.h"
#include "app/ui/computed/live_map.h"
#include "app/ui/computed/map_choice.h"
#include "tests/window_benchmark/measurements.h"

namespace hapticwall::window_benchmark {
namespace {

constexpr std::chrono::milliseconds kFrame{16};  // the window takes results once a frame

void print(const char* what, std::chrono::steady_clock::time_point start, std::clock_t processor) {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  std::printf("%-14s %8.2f s %14.2f s\n", what, wall.count(),
              static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC);
}

}  // namespace

int measure_map() {
  const auto loaded = file::load_scene("press");
  if (!loaded) return EXIT_FAILURE;
  ui::MapChoice choice;
  ui::LiveMap live;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  live.ask_for(ui::map_of(choice, loaded->scene));
  std::printf("%zu x %zu cells of press    wall      processor\n", ui::kLiveMapValues,
              ui::kLiveMapValues);
  for (bool first = true; live.running(); std::this_thread::sleep_for(kFrame)) {
    live.take();
    if (first && live.up_to_date()) print("first picture", start, processor);
    first = first && !live.up_to_date();
  }
  print("whole map", start, processor);
  return live.complete() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace hapticwall::window_benchmark
