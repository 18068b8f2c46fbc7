#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/draw/plot/extra_traces.h"
#include "app/ui/page/plots_panel.h"
#include "app/ui/state/compare_state.h"
#include "app/ui/state/comparing.h"
#include "app/ui/state/plots_state.h"

namespace hapticwall::ui {
namespace {

using compare::Ghost;
using compare::TracePoint;

constexpr float kStrength = 0.42F;  // opacity relative to the line's colour
constexpr draw::LineSet kGhostLines = draw::kExtraLines | draw::line_bit(&Sample::penetration_m) |
                                      draw::line_bit(&Sample::energy_hold_j) |
                                      draw::line_bit(&Sample::energy_scv_j) |
                                      draw::line_bit(&Sample::energy_budget_j);

// Sample of the ghost at the time of the present contact, added to the ledger at its start.
Sample sample_at(const Ghost& ghost, const TracePoint& point, double rate_hz) {
  Sample sample;
  sample.tick = ghost.present_onset_tick + point.ticks;
  sample.time_s = static_cast<double>(sample.tick) / rate_hz;
  sample.position_m = point.position_m;
  sample.penetration_m = point.penetration_m;
  sample.force_n = point.force_n;
  sample.stiffness_n_per_m = point.stiffness_n_per_m;
  sample.energy_cv_j = ghost.before.cv_j + point.energy_cv_j;
  sample.energy_hold_j = ghost.before.hold_j + point.energy_hold_j;
  sample.energy_scv_j = ghost.before.scv_j + point.energy_scv_j;
  sample.energy_budget_j = ghost.before.budget_j + point.energy_budget_j;
  return sample;
}

draw::ExtraTrace trace_of(const Ghost& ghost, const Scene& scene,
                          const AlgorithmSettings& settings) {
  auto history =
      std::make_shared<draw::SampleHistory>(ghost.points.size(), scene.x().device.encoder_m);
  for (const TracePoint& point : ghost.points)
    history->push(sample_at(ghost, point, scene.sampling.rate_hz));
  draw::ExtraTrace trace;
  trace.label =
      fmt::format("ghost of {}: {}", compare::slot_name(ghost.slot), algorithm_name(settings));
  trace.history = std::move(history);
  trace.strength = kStrength;
  trace.lines = kGhostLines;
  return trace;
}

}  // namespace

void show_ghost(const PanelContext& context) {
  CompareState& compare = context.compare;
  std::optional<Ghost> ghost;
  if (compare.transient.comparison && compare.persisted.ghost_shown)
    ghost = compare.transient.comparison->ghost();
  std::optional<ShownGhost> wanted;
  if (ghost) {
    const AlgorithmSettings& settings = compare.transient.comparison->settings(ghost->slot);
    wanted =
        ShownGhost{ghost->slot, ghost->present_onset_tick, ghost->points.size(), settings.index};
  }
  if (wanted == compare.transient.shown_ghost) return;
  compare.transient.shown_ghost = wanted;
  std::vector<draw::ExtraTrace> traces;
  if (ghost) {
    traces.push_back(trace_of(*ghost, context.session.scene(),
                              compare.transient.comparison->settings(ghost->slot)));
  }
  replace_extra_traces(context.plots.transient.extra_traces, draw::ExtraSource::kComparison,
                       std::move(traces));
}

}  // namespace hapticwall::ui
