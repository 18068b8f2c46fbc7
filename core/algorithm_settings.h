// A scene's choice of algorithm, with the values of the algorithms' keys.
//
// Every algorithm declares its keys (algorithm.h), and their union is one fixed table. The values
// are therefore a trivially copyable array, shared by a scene, the window and the real-time thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/parameter.h"

namespace hapticwall {

inline constexpr std::size_t kMaxAlgorithmParameters = 40;  // with those of plug-ins

// Index of the algorithm in the closed list (algorithm.h) and a value (or nothing) for every key
// of algorithm_parameters(), in its order. A boolean is 0 or 1, a choice is its index.
struct AlgorithmSettings {
  std::size_t index = 0;
  // Revision of a plug-in, whose file may be loaded again: 1 is the first load, 0 the newest one.
  std::uint32_t revision = 0;
  std::array<std::optional<double>, kMaxAlgorithmParameters> values{};

  friend bool operator==(const AlgorithmSettings&, const AlgorithmSettings&) = default;
};

}  // namespace hapticwall
