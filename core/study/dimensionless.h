// Dimensionless forms of scene numbers, which make maps of different devices comparable.
#pragma once

#include <optional>
#include <string_view>

#include "core/study/stability_map.h"

namespace hapticwall {

struct Dimensionless {
  std::string_view symbol;  // "K T²/m"
  double factor = 1.0;      // of a value of the axis
};

// K T²/m of the first wall's stiffness, B T/m of its damping, b T/m of the device's damping,
// f_c/(K Δ) of its friction; m is the mass of the handle. nullopt for other numbers, and if the
// other axis changes the factor. Realtime-safe: no.
[[nodiscard]] std::optional<Dimensionless> dimensionless(const Scene& scene, const MapAxis& axis,
                                                         const MapAxis& other);

}  // namespace hapticwall
