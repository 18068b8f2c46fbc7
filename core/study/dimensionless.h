// Numbers of a scene without their units: what makes maps of different devices comparable.
#pragma once

#include <optional>
#include <string_view>

#include "core/study/stability_map.h"

namespace hapticwall {

struct Dimensionless {
  std::string_view symbol;  // "K T²/m"
  double factor = 1.0;      // times a value of the axis
};

// K T²/m of the first wall's stiffness, B T/m of its damping, b T/m of the device's damping,
// f_c/(K Δ) of its friction; m is the handle's mass. Nothing for other numbers, and where the other
// axis changes what the factor is made of. Realtime-safe: no.
[[nodiscard]] std::optional<Dimensionless> dimensionless(const Scene& scene, const MapAxis& axis,
                                                         const MapAxis& other);

}  // namespace hapticwall
