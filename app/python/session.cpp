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
SessionBox::SessionBox(const SceneBox& scene) : scene_(scene) {
  mark_.emplace();
  const Scene& whole = scene_of_study(scene);
  refuse_pointer(whole);
  axes_.emplace(whole);
}

void SessionBox::refuse_tick() const {
  throw std::runtime_error("the run diverged at tick " + std::to_string(tick()) +
                           "; there is no further tick");
}

const Sample& SessionBox::step(double hand_force_n, double hand_force_y_n) {
  if (!mark_) throw std::runtime_error("the session is closed");
  if (!std::isfinite(hand_force_n) || !std::isfinite(hand_force_y_n))
    throw std::invalid_argument("a force of the hand is a finite number of newtons");
  if (axes_->count() == 1 && hand_force_y_n != 0.0)
    throw std::invalid_argument("this scene has no second axis");
  if (diverged()) refuse_tick();
  axes_->push_hand(0, hand_force_n);
  if (axes_->count() > 1) axes_->push_hand(1, hand_force_y_n);
  if (!axes_->pass_tick()) refuse_tick();
  return axes_->sample(0);
}

void SessionBox::set(const Settings& settings) {
  const SceneBox changed = scene_.with(settings);
  const Scene& wanted = changed.loaded().scene;
  if (const auto problem = session::needs_new_session(scene_.loaded().scene, wanted))
    throw std::invalid_argument(problem->key + ": " + problem->message);
  axes_->change(wanted);
  scene_ = changed;
}

double SessionBox::time_s() const {
  return static_cast<double>(tick()) / scene_.loaded().scene.sampling.rate_hz;
}

std::size_t SessionBox::checked(std::size_t axis) const {
  if (axis >= axes_->count()) throw std::invalid_argument("this scene has no second axis");
  return axis;
}
double SessionBox::position_m(std::size_t axis) const {
  return axes().plant(checked(axis)).measured_position_m();
}
const Sample& SessionBox::sample(std::size_t axis) const { return axes().sample(checked(axis)); }

RunSummary SessionBox::summary() const {
  RunSummary run;
  for (std::size_t i = 0; i < axes().count(); ++i) run.push_back(axes().summary(i));
  return run;
}

namespace {

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

}  // namespace

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
