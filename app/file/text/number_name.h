// Names, symbols and shown units of a scene's numbers, for the axes of figures.
#pragma once

#include <string>
#include <string_view>

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

// "added damping" of "algorithm.added_damping_n_s_per_m": a key without its table and unit.
[[nodiscard]] std::string key_in_words(std::string_view key);

}  // namespace hapticwall::file
