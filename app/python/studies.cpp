#include <fmt/format.h>
#include <nanobind/nanobind.h>

#include <algorithm>
#include <cmath>

#include "app/file/text/text.h"
#include "app/python/interruptible.h"
#include "app/python/law.h"
#include "app/python/runs.h"
#include "core/algorithm/algorithm.h"
#include "core/run/batch_simulator.h"
#include "core/run/simulate.h"
#include "core/scene_keys.h"
#include "core/study/stability_map.h"

namespace hapticwall::python {
namespace {

void refuse_negative(int threads) {
  if (threads < 0) raise(usage_error("threads: 0 or more"));
}

// simulate() runs one axis.
std::vector<Summary> run_scenes(const std::vector<Scene>& scenes, int threads,
                                const StopQuestion& should_stop) {
  try {
    return simulate_all(scenes, {.threads = threads, .should_stop = should_stop, .progress = {}});
  } catch (const SceneRefused& refused) {
    throw SimulationRefused(fmt::format("scene {}: {}", refused.scene, refused.what()));
  }
}

std::vector<RunSummary> run_axes(const std::vector<Scene>& scenes, int threads) {
  refuse_negative(threads);
  std::vector<Scene> of_one_axis;
  for (const Scene& scene : scenes) {
    if (!scene.two_axes()) of_one_axis.push_back(scene);
  }
  const bool locks = std::ranges::any_of(scenes, scene_takes_lock);
  return interruptibly([&](const StopQuestion& should_stop) {
    std::vector<Summary> summaries = run_scenes(of_one_axis, locks ? 1 : threads, should_stop);
    std::vector<RunSummary> runs;
    auto next = summaries.begin();
    for (const Scene& scene : scenes) {
      if (should_stop()) return runs;
      runs.push_back(scene.two_axes()
                         ? summaries_of(simulate_axes(
                               scene, {.on_tick = {}, .should_stop = should_stop, .changes = {}}))
                         : RunSummary{std::move(*next++)});
    }
    return runs;
  });
}

SceneNumber mapped_number(const Scene& scene, const std::string& key) {
  if (auto number = find_scene_number(scene, key)) return *number;
  const std::vector<SceneNumber> numbers = scene_numbers(scene);
  const auto paths = file::names_of(numbers, &SceneNumber::path);
  PyErr_SetString(PyExc_KeyError, fmt::format("no number of this scene is called {}{}",
                                              file::in_quotes(key), file::suggestion(key, paths))
                                      .c_str());
  throw nanobind::python_error();
}

struct MappedNumber {
  SceneNumber number;
  std::span<const double> values;

  [[nodiscard]] Failure problem() const {
    if (!number.whole) return std::nullopt;
    const auto broken =
        std::ranges::find_if(values, [](double value) { return value != std::round(value); });
    const auto beyond =
        std::ranges::find_if(values, [&](double value) { return !number.range.contains(value); });
    if (broken == values.end() && beyond != values.end())
      return usage_error(number.path + ": " +
                         out_of_range_text(*beyond, number.range, number.unit));
    if (broken == values.end()) return std::nullopt;
    return usage_error(fmt::format("{}: {} where a whole number belongs", number.path,
                                   file::shortest_number(*broken)));
  }
};

// A grid of scenes: x varies fastest, then y, then the algorithm.
struct Grid {
  const Scene& scene;
  MappedNumber x;
  MappedNumber y;
  const std::vector<std::size_t>& algorithms;

  [[nodiscard]] std::size_t size() const {
    return x.values.size() * y.values.size() * algorithms.size();
  }
  [[nodiscard]] Scene at(std::size_t cell) const {
    Scene one = scene;
    x.number.set(one, x.values[cell % x.values.size()]);
    y.number.set(one, y.values[cell / x.values.size() % y.values.size()]);
    one.algorithm.index = algorithms[cell / (x.values.size() * y.values.size())];
    return one;
  }
  [[nodiscard]] std::vector<Scene> stretch(std::size_t begin) const {
    constexpr std::size_t kStretch = 8192;  // bounds the memory
    std::vector<Scene> scenes;
    for (std::size_t i = begin; i < std::min(begin + kStretch, size()); ++i)
      scenes.push_back(at(i));
    return scenes;
  }
};

void check(const Grid& grid) {
  constexpr std::size_t kMaxCells = kMaxMapValues * kMaxMapValues;
  if (grid.x.number.path == grid.y.number.path)
    raise(usage_error(fmt::format("x and y are the same key, {}", grid.x.number.path)));
  if (grid.size() == 0) raise(usage_error("a map takes at least one value of each key"));
  if (grid.size() > kMaxCells) {
    raise(
        usage_error(fmt::format("a map of {} cells; it takes at most {}", grid.size(), kMaxCells)));
  }
  if (const Failure problem = grid.x.problem()) raise(*problem);
  if (const Failure problem = grid.y.problem()) raise(*problem);
}

Grid grid_of(const Scene& scene, const MapValues& x, const MapValues& y,
             const std::vector<std::size_t>& algorithms) {
  const Grid grid{scene,
                  {mapped_number(scene, x.first), x.second},
                  {mapped_number(scene, y.first), y.second},
                  algorithms};
  check(grid);
  return grid;
}

// Problem of the first cell that is no scene. One algorithm is enough: another one makes no other
// problem of a number.
Failure cell_problem(const Grid& grid, const StopQuestion& should_stop) {
  for (std::size_t i = 0; i < grid.size() / grid.algorithms.size() && !should_stop(); ++i) {
    if (const auto problem = validate(grid.at(i)))
      return usage_error(problem->key + ": " + problem->message);
  }
  return std::nullopt;
}

Result<std::vector<NumberColumn>> run_cells(const Grid& grid, int threads,
                                            const StopQuestion& should_stop) {
  if (const Failure problem = cell_problem(grid, should_stop)) return *problem;
  const bool locks =
      scene_takes_lock(grid.scene) || std::ranges::any_of(grid.algorithms, takes_lock);
  std::vector<NumberColumn> columns = number_columns(grid.size());
  for (std::size_t done = 0; done < grid.size() && !should_stop();) {
    const std::vector<Summary> more =
        run_scenes(grid.stretch(done), locks ? 1 : threads, should_stop);
    append(columns, more);
    done += more.size();
  }
  return columns;
}

}  // namespace

std::vector<RunSummary> run_batch(const std::vector<SceneBox>& boxes, int threads) {
  std::vector<Scene> scenes;
  scenes.reserve(boxes.size());
  for (const SceneBox& box : boxes) scenes.push_back(scene_of_study(box));
  return run_axes(scenes, threads);
}

std::vector<RunSummary> compare(const SceneBox& scene, const std::vector<std::size_t>& algorithms,
                                int threads) {
  const Scene& compared = scene_of_study(scene);
  const std::vector<ComparedAlgorithm> rows = compared_algorithms(compared.algorithm, algorithms);
  std::vector<Scene> scenes(rows.size(), compared);
  for (std::size_t i = 0; i < rows.size(); ++i) scenes[i].algorithm = rows[i].settings;
  std::vector<RunSummary> runs = run_axes(scenes, threads);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (Summary& axis : runs[i]) axis.algorithm = rows[i].label;
  }
  return runs;
}

std::vector<NumberColumn> map(const SceneBox& scene, const MapValues& x, const MapValues& y,
                              const std::vector<std::size_t>& algorithms, int threads) {
  refuse_negative(threads);
  const Grid grid = grid_of(scene_of_study(scene), x, y, algorithms);
  return value_or_raise(interruptibly(
      [&](const StopQuestion& should_stop) { return run_cells(grid, threads, should_stop); }));
}

void check_map(const SceneBox& scene, const MapValues& x, const MapValues& y,
               const std::vector<std::size_t>& algorithms) {
  const Grid grid = grid_of(scene_of_study(scene), x, y, algorithms);
  const Failure problem = interruptibly(
      [&](const StopQuestion& should_stop) { return cell_problem(grid, should_stop); });
  if (problem) raise(*problem);
}

}  // namespace hapticwall::python
