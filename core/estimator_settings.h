// A scene's choice of velocity estimator, with the values of the estimators' keys. Trivially
// copyable, as AlgorithmSettings.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/parameter.h"

namespace hapticwall {

inline constexpr std::size_t kMaxEstimatorParameters = 16;

// Index of the estimator in estimators() (core/estimator/estimator.h) and a value (or nothing) for
// every key of estimator_parameters(), in its order.
struct EstimatorSettings {
  std::size_t index = 0;  // 0: the backward difference
  std::array<std::optional<double>, kMaxEstimatorParameters> values{};

  friend bool operator==(const EstimatorSettings&, const EstimatorSettings&) = default;
};

}  // namespace hapticwall
