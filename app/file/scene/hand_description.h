// Named hands: mass, stiffness and damping with their source, built in or from TOML files. A
// description has no path: a scene keeps its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "core/scene.h"

namespace hapticwall::file {

struct HandDescription {
  std::string name;
  std::string source;  // where the numbers come from
  HandSettings hand;   // without a path

  friend bool operator==(const HandDescription&, const HandDescription&) = default;
};

// Validates as a scene does. `origin` names the text in messages ("hand.toml:12: hand.mass_kg …").
// Realtime-safe: no.
[[nodiscard]] Result<HandDescription> parse_hand_description(std::string_view toml_text,
                                                             const std::string& origin);

// `name_or_path`: a built-in hand or a file. Realtime-safe: no.
[[nodiscard]] Result<HandDescription> load_hand_description(const std::string& name_or_path);

struct BuiltinHand {
  std::string name;  // name of the file, without ".toml"
  std::string_view toml_text;
};
// In the order of their names.
[[nodiscard]] const std::vector<BuiltinHand>& builtin_hands();

// The scene with these numbers for the hand of every axis that has one. The intended paths stay.
// Realtime-safe: no.
[[nodiscard]] Scene with_hand(Scene scene, const HandSettings& numbers);

}  // namespace hapticwall::file
