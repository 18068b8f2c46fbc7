// How the running scene differs from the loaded one; and numbers as fields show and take them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"

namespace hapticwall::ui {

// One line for each value of device, hand, simulator, walls and algorithm keys that differs from
// the loaded scene. The choice of the algorithm does not count.
[[nodiscard]] std::vector<std::string> changed_values(const Scene& running, const Scene& loaded);

// `running` with all these values from the loaded scene.
[[nodiscard]] Scene with_loaded_values(const Scene& running, const Scene& loaded);

// A finite number as people type it: 35000.5, 35000,5, 3.5e4, 35k, 35 k, 0.2M; nullopt otherwise,
// and for 35,000, which is 35 to some and 35000 to others.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);
// Reason why a text is no number, in one line.
[[nodiscard]] std::string no_number(std::string_view text);

// Rounds to at most ten significant digits, so that no rounding noise is shown.
[[nodiscard]] std::string rounded_number(double value);

// The text for the value of a part that is absent.
inline constexpr const char* kAbsent = "none";
[[nodiscard]] std::string shown_value(const std::optional<double>& value);

}  // namespace hapticwall::ui
