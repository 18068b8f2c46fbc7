#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "app/command/map/map.h"
#include "app/command/map/map_axis.h"
#include "app/command/map/map_report.h"
#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/text/text.h"
#include "core/result.h"
#include "core/study/boundary.h"

namespace hapticwall::command {
namespace {

constexpr double kDefaultTolerance = 1e-3;

Result<double> parse_tolerance(const std::string& text) {
  if (text.empty()) return kDefaultTolerance;
  const std::optional<double> value = file::parsed<double>(text);
  if (value && *value >= kMinTolerance && *value < 1.0) return *value;
  return usage_error(
      fmt::format("--tolerance {}: it takes a relative tolerance, {:g} to less than 1",
                  file::in_quotes(text), kMinTolerance));
}

Result<BoundaryPlan> plan_boundary(const MapOptions& options, Scene scene) {
  Result<MapAxis> along = parse_map_axis("--boundary", options.boundary, scene);
  if (!along) return along.error();
  const Result<double> tolerance = parse_tolerance(options.tolerance);
  if (!tolerance) return tolerance.error();
  Result<std::vector<std::size_t>> algorithms = chosen_algorithms(options.algorithms);
  if (!algorithms) return algorithms.error();
  BoundaryPlan plan;
  plan.algorithms = std::move(*algorithms);
  if (!options.x.empty()) {
    Result<MapAxis> x = parse_map_axis("--x", options.x, scene);
    if (!x) return x.error();
    if (x->number.path == along->number.path) {
      return usage_error(fmt::format("--x and --boundary are the same key, {}", x->number.path));
    }
    plan.x = std::move(*x);
  }
  plan.scene = std::move(scene);
  plan.along = std::move(*along);
  plan.tolerance = *tolerance;
  if (Failure failed = invalid_cell(validate(plan))) return *failed;
  return plan;
}

}  // namespace

Result<int> run_boundary(const MapOptions& options, Scene scene) {
  const Result<BoundaryPlan> plan = plan_boundary(options, std::move(scene));
  if (!plan) return plan.error();
  catch_stop_signals();
  Result<OutputFiles> files = OutputFiles::open(options.output);
  if (!files) return files.error();
  std::vector<Boundary> boundaries;
  {
    Progress progress(fmt::format("boundary of {}", plan->scene.name), !options.output.quiet);
    boundaries = find_boundaries(*plan, {.should_stop = [] { return stop_signal() != 0; },
                                         .progress = [&](double done) { progress.show(done); }});
  }
  if (boundaries.empty()) return ended_early();
  return status_of(files->write({boundary_csv(*plan, boundaries), boundary_json(*plan, boundaries),
                                 boundary_table(*plan, boundaries)}));
}

}  // namespace hapticwall::command
