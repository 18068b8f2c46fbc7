// A scene's choice of environment, with the values of the environments' keys. Trivially copyable,
// as AlgorithmSettings.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/parameter.h"

namespace hapticwall {

inline constexpr std::size_t kMaxEnvironmentParameters = 40;  // with those of plug-ins

// Index of the environment in environments() (core/environment/environment.h) and a value (or
// nothing) for every key of environment_parameters(), in its order.
struct EnvironmentSettings {
  std::size_t index = 0;  // 0: the walls of the scene
  std::array<std::optional<double>, kMaxEnvironmentParameters> values{};

  [[nodiscard]] bool is_walls() const { return index == 0; }
  friend bool operator==(const EnvironmentSettings&, const EnvironmentSettings&) = default;
};

}  // namespace hapticwall
