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

// A finite number as people type it, with `.` as decimal point; nullopt otherwise.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

// Ten significant digits at most, so that no rounding noise is shown.
[[nodiscard]] std::string rounded_number(double value);

// The text for the value of a part that is absent.
inline constexpr const char* kAbsent = "none";
[[nodiscard]] std::string shown_value(const std::optional<double>& value);

}  // namespace hapticwall::ui
