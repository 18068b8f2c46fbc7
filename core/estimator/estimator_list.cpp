// The list of estimators.
#include <algorithm>
#include <array>
#include <iterator>

#include "core/estimator/backward_difference.h"
#include "core/estimator/estimator.h"
#include "core/estimator/foaw.h"
#include "core/estimator/kalman.h"
#include "core/estimator/least_squares.h"
#include "core/estimator/levant.h"
#include "core/estimator/low_pass.h"

namespace hapticwall {
namespace {

// Tables list them in this order. The first one is the default.
constexpr std::array kEstimators{
    estimator_of<BackwardDifference>(),
    estimator_of<LowPass>(),
    estimator_of<LeastSquares>(),
    estimator_of<Foaw>(),
    estimator_of<Levant>(),
    estimator_of<Kalman>(),
};

constexpr auto kEstimatorParameters = unite_parameters<kMaxEstimatorParameters>(kEstimators);

}  // namespace

std::span<const Estimator> estimators() { return kEstimators; }

std::span<const ParameterDescription> estimator_parameters() {
  return kEstimatorParameters.in_use();
}

std::optional<std::size_t> find_estimator(std::string_view name) {
  const auto found = std::ranges::find(
      kEstimators, name, [](const Estimator& estimator) { return estimator.description.name; });
  if (found == kEstimators.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(kEstimators.begin(), found));
}

const Estimator* chosen_estimator(const EstimatorSettings& settings) {
  if (settings.index == 0 || settings.index >= kEstimators.size()) return nullptr;
  return &kEstimators[settings.index];
}

std::optional<VelocityTransfer> velocity_transfer(const EstimatorContext& context) {
  const std::size_t index = context.settings == nullptr ? 0 : context.settings->index;
  if (index >= kEstimators.size() || kEstimators[index].transfer == nullptr) return std::nullopt;
  return kEstimators[index].transfer(context);
}

std::optional<double> EstimatorContext::value(std::string_view key) const {
  if (settings == nullptr) return std::nullopt;
  return find_value(estimator_parameters(), settings->values, key);
}

}  // namespace hapticwall
