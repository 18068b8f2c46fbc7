// Names, symbols and shown units of a scene's numbers, for the axes of figures.
#pragma once

#include <string>

#include "core/scene_keys.h"

namespace hapticwall::file {

struct NumberName {
  std::string name;    // "wall stiffness"
  std::string symbol;  // "K"; "": none
  std::string unit;    // "kN/m"; "": a pure number
  double scale = 1.0;  // from the scene's unit to `unit`

  // "wall stiffness K (kN/m)".
  [[nodiscard]] std::string title() const;
};

// A number without an entry in the table has its key as name, in words and without the unit.
[[nodiscard]] NumberName number_name(const SceneNumber& number);

}  // namespace hapticwall::file
