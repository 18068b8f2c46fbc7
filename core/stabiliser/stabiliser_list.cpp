#include "core/stabiliser/stabiliser_list.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/scene_keys.h"

namespace hapticwall {
namespace {

template <typename Tuple>
struct Descriptions;
template <typename... Stabiliser>
struct Descriptions<std::tuple<Stabiliser...>> {
  static constexpr std::array<AlgorithmDescription, sizeof...(Stabiliser)> kAll{
      Stabiliser::kDescription...};
};
constexpr const auto& kAlgorithms = Descriptions<StabiliserTuple>::kAll;

struct ParameterUnion {
  std::array<ParameterDescription, kMaximumAlgorithmParameters> parameters{};
  std::size_t count = 0;
};

constexpr ParameterUnion unite_parameters() {
  ParameterUnion all;
  all.parameters.at(all.count++) = kThenParameter;
  for (const AlgorithmDescription& algorithm : kAlgorithms) {
    for (const ParameterDescription& parameter : algorithm.parameters) {
      const auto begin = all.parameters.begin();
      const auto end = begin + static_cast<std::ptrdiff_t>(all.count);
      const bool known = std::any_of(begin, end, [&](const ParameterDescription& other) {
        return other.key == parameter.key;
      });
      if (!known) all.parameters.at(all.count++) = parameter;  // too many: does not compile
    }
  }
  return all;
}
constexpr ParameterUnion kParameterUnion = unite_parameters();

}  // namespace

std::span<const AlgorithmDescription> algorithms() { return kAlgorithms; }

std::optional<std::size_t> find_algorithm(std::string_view name) {
  const auto found = std::find_if(kAlgorithms.begin(), kAlgorithms.end(),
                                  [&](const auto& algorithm) { return algorithm.name == name; });
  if (found == kAlgorithms.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(kAlgorithms.begin(), found));
}

std::span<const ParameterDescription> algorithm_parameters() {
  return {kParameterUnion.parameters.data(), kParameterUnion.count};
}

std::optional<std::size_t> find_algorithm_parameter(std::string_view key) {
  const auto all = algorithm_parameters();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const auto& parameter) { return parameter.key == key; });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(all.begin(), found));
}

std::optional<double> StabiliserContext::value(std::string_view key) const {
  const std::optional<std::size_t> index = find_algorithm_parameter(key);
  if (settings == nullptr || !index) return std::nullopt;
  return settings->values[*index];
}

double believed_damping(const StabiliserContext& context) {
  return context.value_or(kBelievedDampingParameter.key, context.device_damping_n_s_per_m);
}

bool has_follower(const AlgorithmSettings& settings) {
  const StabiliserContext context{.walls = {}, .settings = &settings};
  return context.value_or(kThenParameter.key, 0.0) != 0.0;
}

std::string algorithm_label(const AlgorithmSettings& settings) {
  std::string label(kAlgorithms.at(settings.index).name);
  if (has_follower(settings)) label += " then " + std::string(kFollowers.back());
  return label;
}

bool reads(const AlgorithmSettings& settings, std::string_view key) {
  const auto has_key = [key](const AlgorithmDescription& algorithm) {
    return std::ranges::any_of(algorithm.parameters, [key](const ParameterDescription& parameter) {
      return parameter.key == key;
    });
  };
  return key == kThenParameter.key || has_key(kAlgorithms.at(settings.index)) ||
         (has_follower(settings) && has_key(PassivityControl::kDescription));
}

std::string value_text(const ParameterDescription& parameter, double value) {
  if (parameter.kind == ParameterKind::kBoolean) return value != 0.0 ? "true" : "false";
  if (parameter.kind == ParameterKind::kChoice) {
    return std::string(parameter.choices[static_cast<std::size_t>(value)]);
  }
  return number_text(value);
}

}  // namespace hapticwall
