#include "core/run/measured_axes.h"

#include <algorithm>
#include <optional>
#include <string>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

TickStats stats_of(const Sample& sample) {
  return {sample.truth.position_m,
          sample.truth.velocity_m_per_s,
          sample.truth.actuator_work_j + sample.truth.dissipation_j,
          sample.penetration_m,
          sample.force_n,
          (sample.flags & kFlagInContact) != 0,
          (sample.flags & kFlagForceLimit) != 0};
}

double net_work_j(const PlantTruth& truth) {
  return truth.actuator_work_j + truth.dissipation_j + truth.kinetic_j;
}

}  // namespace

MeasuredAxes::MeasuredAxes(const Scene& scene) {
  axes_.reserve(scene.axes.size());
  for (std::size_t i = 0; i < scene.axes.size(); ++i) axes_.emplace_back(axis_scene(scene, i));
}

void MeasuredAxes::push_hand(std::size_t axis, double force_n) {
  Axis& pushed = axes_[axis];
  pushed.stepped.plant().push_hand(force_n);
  pushed.pushed = pushed.pushed || force_n != 0.0;
}

bool MeasuredAxes::compute() {
  if (axes_.size() == 2 && axes_.front().stepped.needs_other_axis())
    return SteppedAxis::compute_together(axes_.front().stepped, axes_.back().stepped);
  bool all = true;
  for (Axis& axis : axes_) all = axis.stepped.compute() != nullptr && all;
  return all;
}

bool MeasuredAxes::pass_tick() {
  if (diverged() || !compute()) return false;
  for (Axis& axis : axes_) {
    axis.sample = axis.stepped.sample();
    axis.metrics.add(axis.sample.tick, stats_of(axis.sample), ledger_of(axis.sample));
    axis.stepped.advance();
    axis.metrics.add_net_work(net_work_j(axis.stepped.plant().truth()));
  }
  return true;
}

void MeasuredAxes::check_work() const {
  for (const Axis& axis : axes_) {
    if (!axis.stepped.plant().gave_up()) continue;
    throw SimulationRefused("tick " + std::to_string(tick()) + " under " +
                            algorithm_label(axis.stepped.scene().algorithm) + " is " +
                            std::string(kTooMuchWork));
  }
}

void MeasuredAxes::change(const Scene& scene) {
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].stepped.change(axis_scene(scene, i));
}

std::uint64_t MeasuredAxes::tick() const {
  std::uint64_t tick = axes_.front().stepped.tick();
  for (const Axis& axis : axes_) {
    if (axis.stepped.diverged()) tick = axis.stepped.tick();
  }
  return tick;
}

bool MeasuredAxes::diverged() const {
  return std::ranges::any_of(axes_, [](const Axis& axis) { return axis.stepped.diverged(); });
}

Summary MeasuredAxes::summary(std::size_t index) const {
  const Axis& axis = axes_[index];
  const Scene& scene = axis.stepped.scene();
  const PlantTruth& truth = axis.stepped.plant().truth();
  const auto energies = plant_energies(truth.actuator_work_j, truth.dissipation_j,
                                       truth.hand_work_j, truth.kinetic_j);
  const std::uint64_t ticks = axis.stepped.tick();
  RunEnd end{ticks, std::nullopt, false};
  if (axis.stepped.diverged()) end.diverged_at_tick = ticks;
  const std::uint64_t planned = scene.tick_count();
  end.hand_rests =
      !axis.pushed && hand_rests(scene, tail_begin_tick(planned, scene.sampling.rate_hz), planned);
  return summarise(scene, axis.metrics.stats(), ledger_of(axis.sample), energies, end);
}

}  // namespace hapticwall
