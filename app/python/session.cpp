#include "app/python/session.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "app/python/results.h"
#include "app/session/scene_change.h"
#include "core/run/simulate.h"

namespace nb = nanobind;

namespace hapticwall::python {
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

SessionBox::SessionBox(const SceneBox& scene) : scene_(scene) {
  mark_.emplace();
  const Scene& whole = scene_of_study(scene);
  refuse_pointer(whole);
  axes_.reserve(whole.axes.size());
  for (std::size_t i = 0; i < whole.axes.size(); ++i) axes_.emplace_back(axis_scene(whole, i));
}

void SessionBox::pass_tick(Axis& axis, double hand_force_n) {
  PlantModel& plant = axis.stepped.plant();
  plant.push_hand(hand_force_n);
  axis.pushed = axis.pushed || hand_force_n != 0.0;
  const Sample* sample = axis.stepped.compute();
  if (sample == nullptr) {
    throw std::runtime_error("the run diverged at tick " + std::to_string(axis.stepped.tick()) +
                             "; there is no further tick");
  }
  axis.sample = *sample;
  axis.metrics.add(sample->tick, stats_of(*sample), ledger_of(*sample));
  axis.stepped.advance();
  axis.metrics.add_net_work(net_work_j(plant.truth()));
}

const Sample& SessionBox::step(double hand_force_n, double hand_force_y_n) {
  if (!mark_) throw std::runtime_error("the session is closed");
  if (!std::isfinite(hand_force_n) || !std::isfinite(hand_force_y_n))
    throw std::invalid_argument("a force of the hand is a finite number of newtons");
  if (axes_.size() == 1 && hand_force_y_n != 0.0)
    throw std::invalid_argument("this scene has no second axis");
  for (const Axis& axis : axes_) {
    if (!axis.stepped.diverged()) continue;
    throw std::runtime_error("the run diverged at tick " + std::to_string(axis.stepped.tick()) +
                             "; there is no further tick");
  }
  pass_tick(axes_.front(), hand_force_n);
  if (axes_.size() > 1) pass_tick(axes_.back(), hand_force_y_n);
  return axes_.front().sample;
}

void SessionBox::set(const Settings& settings) {
  const SceneBox changed = scene_.with(settings);
  const Scene& wanted = changed.loaded().scene;
  if (const auto problem = session::needs_new_session(scene_.loaded().scene, wanted))
    throw std::invalid_argument(problem->key + ": " + problem->message);
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].stepped.change(axis_scene(wanted, i));
  scene_ = changed;
}

double SessionBox::time_s() const {
  return static_cast<double>(tick()) / scene_.loaded().scene.sampling.rate_hz;
}

const SessionBox::Axis& SessionBox::axis(std::size_t index) const {
  if (index >= axes_.size()) throw std::invalid_argument("this scene has no second axis");
  return axes_[index];
}
double SessionBox::position_m(std::size_t index) const {
  return axis(index).stepped.plant().measured_position_m();
}
const Sample& SessionBox::sample(std::size_t index) const { return axis(index).sample; }

bool SessionBox::diverged() const {
  for (const Axis& axis : axes_) {
    if (axis.stepped.diverged()) return true;
  }
  return false;
}

Summary SessionBox::summary_of(const Axis& axis) const {
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

RunSummary SessionBox::summary() const {
  RunSummary run;
  for (const Axis& axis : axes_) run.push_back(summary_of(axis));
  return run;
}

void bind_sample(nb::module_& m) {
  nb::class_<Sample> sample(m, "Sample");
  for (const SampleColumn& column : kSampleColumns) {
    std::visit(
        [&](auto member) {
          if constexpr (std::is_same_v<decltype(member), double PlantTruth::*>) {
            sample.def_prop_ro(column.name.data(),
                               [member](const Sample& of) { return of.truth.*member; });
          } else {
            sample.def_ro(column.name.data(), member);
          }
        },
        column.member);
  }
}

void bind_session(nb::module_& m) {
  bind_sample(m);
  nb::class_<SessionBox>(m, "Session")
      .def(nb::init<const SceneBox&>())
      .def("step", &SessionBox::step, nb::arg("hand_force_n") = 0.0,
           nb::arg("hand_force_y_n") = 0.0, nb::rv_policy::reference_internal)
      .def("close", &SessionBox::close)
      .def("change", &SessionBox::set)
      .def("measured_m", &SessionBox::position_m)
      .def("newest", &SessionBox::sample, nb::rv_policy::reference_internal)
      .def_prop_ro("tick", &SessionBox::tick)
      .def_prop_ro("time_s", &SessionBox::time_s)
      .def_prop_ro("position_m", [](const SessionBox& s) { return s.position_m(0); })
      .def_prop_ro("diverged", &SessionBox::diverged)
      .def_prop_ro("core_scene", &SessionBox::scene)
      .def("core_summary", [](const SessionBox& s) { return summary_dict(s.summary()); });
}

}  // namespace hapticwall::python
