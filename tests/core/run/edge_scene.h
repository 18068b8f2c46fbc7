// A scene with one soft wall and a hand that goes in and out; tests move it to the edge.
#pragma once

#include "core/scene.h"

namespace hapticwall::testing {

inline Scene pressed() {
  Scene scene;
  scene.name = "edge";
  scene.duration_s = 0.3;
  scene.x().walls = {{.position_m = 0.05, .stiffness_n_per_m = 1000.0}};
  scene.x().hand.emplace();
  scene.x().hand->stiffness_n_per_m = 300.0;
  scene.x().hand->damping_n_s_per_m = 5.0;
  scene.x().hand->path = {{0.0, 0.03}, {0.1, 0.06}, {0.2, 0.02}};
  return scene;
}

template <typename Visitor>
void for_each_integrator(Scene scene, const Visitor& visitor) {
  for (const Integrator integrator :
       {Integrator::kExact, Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4}) {
    scene.simulator = {integrator, integrator == Integrator::kExact ? 1 : 10};
    visitor(scene);
  }
}

}  // namespace hapticwall::testing
