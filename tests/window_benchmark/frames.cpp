#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "app/ui/window/application.h"
#include "core/algorithm/algorithm.h"
#include "core/units.h"
#include "tests/app/ui/fake_session.h"
#include "tests/app/ui/show_everything.h"
#include "tests/window_benchmark/measurements.h"
#include "tests/window_benchmark/stage.h"

namespace hapticwall::window_benchmark {
namespace {

constexpr const char* kScene = "tap";  // without an algorithm: its signals never come to rest
constexpr double kRateHz = 1000.0;
constexpr int kTicksAFrame = 17;        // the session goes on, as at 60 pictures a second
constexpr int kTicksAtATime = 100'000;  // ticks that the window takes at once
constexpr int kRounds = 20;
constexpr int kFramesAVisit = 2;  // after one that is not counted
constexpr int kMinuteTicks = 60'000;
constexpr int kHourTicks = 3'600'000;
constexpr int kFirstTicks = 59'000;  // of the window as it opens
constexpr double kFollowedS = 6.0;
constexpr double kMaxHourToMinute = 1.3;

struct Size {
  int width;
  int height;
};
constexpr Size kSizes[] = {{1280, 720}, {1920, 1080}};

// A window on a session with so much history.
struct Window {
  int ticks = 0;
  std::unique_ptr<ui::Application> application;
  test::FakeSession* session = nullptr;
};

// Measured case: so much of a window's history in sight, or an empty window.
struct Row {
  std::string name;
  int ticks = 0;
  double window_s = 0.0;
  Window* window = nullptr;
  std::vector<double> wall_s;
  std::vector<double> processor_s;
};

std::vector<Row> rows() {
  std::vector<Row> rows;
  rows.push_back({"an empty window", 0, 0.0, nullptr, {}, {}});
  rows.push_back({"following 6 s, a minute of history", kMinuteTicks, kFollowedS, nullptr, {}, {}});
  rows.push_back({"following 6 s, an hour of history", kHourTicks, kFollowedS, nullptr, {}, {}});
  rows.push_back({"the first window, two walls", kFirstTicks, kFollowedS, nullptr, {}, {}});
  for (const int ticks : {10'000, kMinuteTicks, 100'000, 1'000'000, kHourTicks}) {
    rows.push_back({std::to_string(ticks) + " samples, all in sight",
                    ticks,
                    ticks / kRateHz,
                    nullptr,
                    {},
                    {}});
  }
  return rows;
}

Failure open(Window& window, const Stage& stage, const Scene& scene) {
  ui::Application::Sessions sessions;
  sessions.simulate =
      [&window](const Scene& wanted,
                BorrowedAlgorithm* /*borrowed*/) -> Result<std::unique_ptr<session::LiveSession>> {
    auto session = std::make_unique<test::FakeSession>(wanted);
    window.session = session.get();
    return std::unique_ptr<session::LiveSession>(std::move(session));
  };
  auto application = ui::Application::create(scene, {}, stage.theme(), sessions);
  if (!application) return application.error();
  window.application = std::move(*application);
  if (window.ticks != kFirstTicks) test::show_everything(window.application->state());
  for (int done = 0; done < window.ticks; done += kTicksAtATime) {
    window.session->advance(std::min(kTicksAtATime, window.ticks - done));
    window.application->take_ticks();
  }
  return std::nullopt;
}

// A window for every length of history.
Failure open_windows(std::vector<Row>& rows, std::map<int, Window>& windows, const Stage& stage,
                     const Scene& scene) {
  for (Row& row : rows) {
    if (row.ticks == 0) continue;
    Window& window = windows[row.ticks];
    row.window = &window;
    if (window.application) continue;
    window.ticks = row.ticks;
    if (Failure failure = open(window, stage, scene)) return failure;
  }
  return std::nullopt;
}

void draw_empty_window() {
  ImGui::SetNextWindowPos(ImVec2(0.0F, 0.0F));
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::Begin("empty", nullptr, ImGuiWindowFlags_NoDecoration);
  ImGui::End();
}

FrameCost one_frame(Row& row, Stage& stage) {
  if (row.window == nullptr) return stage.frame(draw_empty_window);
  ui::Application& application = *row.window->application;
  application.state().time.window_s = row.window_s;
  row.window->session->advance(kTicksAFrame);
  return stage.frame([&] { application.frame(); });
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Rows take turns: what else the machine does hits all of them alike.
void measure(std::vector<Row>& rows, Stage& stage) {
  for (int round = 0; round < kRounds; ++round) {
    for (Row& row : rows) {
      static_cast<void>(one_frame(row, stage));
      for (int i = 0; i < kFramesAVisit; ++i) {
        const FrameCost cost = one_frame(row, stage);
        row.wall_s.push_back(cost.wall_s);
        row.processor_s.push_back(cost.processor_s);
      }
    }
  }
}

const Row& find(const std::vector<Row>& rows, int ticks, bool following) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.ticks == ticks && (row.window_s == kFollowedS) == following;
  });
}

void print_hour_to_minute(const std::vector<Row>& rows, const char* what, bool following) {
  const Row& minute = find(rows, kMinuteTicks, following);
  const Row& hour = find(rows, kHourTicks, following);
  std::printf("an hour to a minute, %s: %.2fx, processor %.2fx (at most %.1fx is wanted)\n", what,
              median(hour.wall_s) / median(minute.wall_s),
              median(hour.processor_s) / median(minute.processor_s), kMaxHourToMinute);
}

void print_table(const std::vector<Row>& rows, const Stage& stage, Size size) {
  std::printf("\n%dx%d, %s, median of %zu frames\n%-38s %9s %8s %14s %8s\n", size.width,
              size.height, stage.renderer().c_str(), rows.front().wall_s.size(), "", "ms", "ratio",
              "processor, ms", "ratio");
  const double empty_wall_s = median(rows.front().wall_s);
  const double empty_processor_s = median(rows.front().processor_s);
  for (const Row& row : rows) {
    const double wall_s = median(row.wall_s);
    const double processor_s = median(row.processor_s);
    std::printf("%-38s %9.2f %7.1fx %14.2f %7.1fx\n", row.name.c_str(),
                wall_s * kMillisecondsPerSecond, wall_s / empty_wall_s,
                processor_s * kMillisecondsPerSecond, processor_s / empty_processor_s);
  }
  print_hour_to_minute(rows, "all in sight", false);
  print_hour_to_minute(rows, "following", true);
}

Failure measure_at(Size size, const Scene& scene) {
  auto stage = Stage::create(size.width, size.height);
  if (!stage) return stage.error();
  std::vector<Row> all = rows();
  std::map<int, Window> windows;  // gone before the stage is
  if (Failure failure = open_windows(all, windows, **stage, scene)) return failure;
  measure(all, **stage);
  print_table(all, **stage, size);
  std::fflush(stdout);
  return std::nullopt;
}

}  // namespace

int measure_frames() {
  auto loaded = file::load_scene(kScene);
  if (!loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().message.c_str());
    return EXIT_FAILURE;
  }
  loaded->scene.algorithm.index = find_algorithm("none").value();
  std::printf(
      "One frame of the window, from its beginning to the last pixel, scene '%s' without an "
      "algorithm\n",
      kScene);
  for (const Size& size : kSizes) {
    if (const Failure failure = measure_at(size, loaded->scene)) {
      std::fprintf(stderr, "%s\n", failure->message.c_str());
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

}  // namespace hapticwall::window_benchmark
