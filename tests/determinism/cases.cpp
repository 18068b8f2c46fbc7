#include "tests/determinism/cases.h"

#include <array>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/map/map_rows.h"
#include "app/file/recording/recording_writer.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "core/scene_keys.h"
#include "core/study/stability_map.h"

namespace hapticwall::determinism {
namespace {

using Overrides = std::vector<std::string>;  // values of --set

Scene loaded(const std::string& name, const Overrides& overrides) {
  auto scene = file::load_scene(name, overrides);
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(scene->scene);
}

std::string with_settings(std::string arguments, const Overrides& overrides) {
  for (const std::string& setting : overrides) arguments += " --set " + setting;
  return arguments;
}

// The SHA-256 of the recording of a headless run.
std::string recording_of(const Scene& scene) {
  const file::CsvColumns columns = file::csv_columns(true, scene.axes.size());
  file::Sha256 digest;
  digest.update(file::csv_header(columns) + "\n");
  std::string row;
  AxesOptions options;
  options.on_tick = [&](const Tick& tick) {
    if (!is_finite(tick)) return;
    row.clear();
    file::append_csv_row(row, tick, columns);
    digest.update(row);
  };
  static_cast<void>(simulate_axes(scene, options));
  return digest.finish();
}

void add_run(std::vector<Case>& cases, const std::string& scene, std::string_view algorithm,
             const Overrides& overrides) {
  Overrides all{"algorithm.name=" + std::string(algorithm)};
  all.insert(all.end(), overrides.begin(), overrides.end());
  cases.push_back(
      {with_settings("run " + scene + " --algorithm " + std::string(algorithm), overrides),
       recording_of(loaded(scene, all))});
}

void add_every_scene_and_algorithm(std::vector<Case>& cases) {
  for (const file::BuiltinScene& scene : file::builtin_scenes()) {
    for (const AlgorithmDescription& algorithm : algorithms()) {
      add_run(cases, scene.name, algorithm.name, {});
    }
  }
}

void add_every_stepping_integrator(std::vector<Case>& cases) {
  for (const std::string_view integrator : {"semi-implicit-euler", "rk4"}) {
    for (const std::string_view substeps : {"3", "8"}) {
      for (const std::string_view scene : {"press", "golden-soft-fric"}) {
        add_run(cases, std::string(scene), "energy-bounding",
                {"simulator.integrator=" + std::string(integrator),
                 "simulator.substeps=" + std::string(substeps)});
      }
    }
  }
}

// Parts that no built-in scene has: delay, an amplifier's lag, a force's resolution, a damped wall,
// a rate whose period is no whole number of anything, an algorithm that follows another.
void add_every_part(std::vector<Case>& cases) {
  const std::array<Overrides, 6> parts{{{"device.delay_ticks=2"},
                                        {"device.amplifier_time_constant_s=0.0007"},
                                        {"device.force_resolution_n=0.01"},
                                        {"wall.damping_n_s_per_m=3"},
                                        {"sampling.rate_hz=3000"},
                                        {"algorithm.then=passivity-control"}}};
  for (const Overrides& part : parts) {
    for (const std::string_view scene : {"press", "tap"}) {
      add_run(cases, std::string(scene), "energy-bounding", part);
    }
  }
}

// Loops and devices that are not ideal: their random numbers, and friction that falls with speed.
void add_every_departure(std::vector<Case>& cases) {
  const std::array<Overrides, 6> departures{
      {{"sampling.render_every=3"},
       {"sampling.lost_ticks=0.1", "sampling.seed=7"},
       {"sampling.jitter=0.2"},
       {"device.position_noise_m=2e-6", "sampling.seed=2000000000"},
       {"device.force_noise_n=0.05", "device.delay_ticks=1"},
       {"device.static_friction_n=0.3", "device.stribeck_speed_m_per_s=0.01",
        "simulator.integrator=rk4"}}};
  for (const Overrides& departure : departures) {
    for (const std::string_view scene : {"press", "corner"}) {
      add_run(cases, std::string(scene), "energy-bounding", departure);
    }
  }
}

MapAxis axis(const Scene& scene, const char* path, double low, double high, std::size_t count) {
  return {find_scene_number(scene, path).value(), low, high, count, false};
}

void add_map(std::vector<Case>& cases, std::size_t threads) {
  StabilityMap map;
  map.scene = loaded("press", {});
  map.algorithms = {find_algorithm("none").value(), find_algorithm("energy-bounding").value()};
  map.x = axis(map.scene, "wall.stiffness_n_per_m", 1000.0, 41000.0, 11);
  map.y = axis(map.scene, "device.damping_n_s_per_m", 0.0, 4.0, 5);
  std::string text = file::map_header(map);
  std::vector<std::size_t> cells(map.cell_count());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  const std::vector<MapMetrics> figures = run_cells(map, cells, static_cast<int>(threads));
  for (std::size_t cell = 0; cell < figures.size(); ++cell) {
    file::append_map_row(text, map, cell, figures[cell]);
  }
  file::Sha256 digest;
  digest.update(text);
  cases.push_back(
      {"map press --algorithms none,energy-bounding"
       " --x wall.stiffness_n_per_m=1000:41000:11"
       " --y device.damping_n_s_per_m=0:4:5, threads: " +
           std::to_string(threads),
       digest.finish()});
}

}  // namespace

std::vector<Case> compute_cases() {
  std::vector<Case> cases;
  add_every_scene_and_algorithm(cases);
  add_every_stepping_integrator(cases);
  add_every_part(cases);
  add_every_departure(cases);
  for (const std::size_t threads : {1U, 2U, 5U}) add_map(cases, threads);
  return cases;
}

}  // namespace hapticwall::determinism
