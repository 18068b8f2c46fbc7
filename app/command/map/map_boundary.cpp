#include "app/command/map_boundary.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>
#include <vector>

#include "app/command/map_axis.h"
#include "app/command/map_report.h"
#include "app/command/output_file.h"
#include "app/command/progress.h"
#include "app/command/signals.h"
#include "app/command/terminal.h"
#include "app/file/text.h"
#include "core/study/boundary.h"
#include "core/usage_error.h"

namespace hapticwall::command {
namespace {

constexpr double kDefaultTolerance = 1e-3;

Result<double> parse_tolerance(const std::string& text) {
  if (text.empty()) return kDefaultTolerance;
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || rest != end || !(value >= kFinestTolerance && value < 1.0)) {
    return usage_error(
        fmt::format("--tolerance {}: it takes a part of the value, {:g} to less "
                    "than 1",
                    file::in_quotes(text), kFinestTolerance));
  }
  return value;
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

int run_boundary(const MapOptions& options, Scene scene) {
  const Result<BoundaryPlan> plan = plan_boundary(options, std::move(scene));
  if (!plan) return report(plan.error());
  catch_stop_signals();
  OutputFile csv;
  OutputFile json;
  if (const Failure failed = csv.open(options.output.csv)) return report(*failed);
  if (const Failure failed = json.open(options.output.json)) return report(*failed);
  std::vector<Boundary> boundaries;
  {
    Progress progress(fmt::format("boundary of {}", plan->scene.name), !options.output.quiet);
    boundaries = find_boundaries(*plan, {.should_stop = [] { return stop_signal() != 0; },
                                         .progress = [&](double done) { progress.show(done); }});
  }
  if (boundaries.empty()) {
    tell(fmt::format("ended early by {}; nothing was written", signal_name(stop_signal())));
    return signal_exit_status(stop_signal());
  }
  if (const Failure failed = csv.write_whole(boundary_csv(*plan, boundaries))) {
    return report(*failed);
  }
  const std::string text = boundary_json(*plan, boundaries);
  if (const Failure failed = json.write_whole(text)) return report(*failed);
  Failure failed;
  if (options.output.json == kStandardOutput) {
    failed = write_output(text);
  } else if (!options.output.quiet) {
    failed = write_output(boundary_table(*plan, boundaries));
  }
  return failed ? report(*failed) : 0;
}

}  // namespace hapticwall::command
