// The list of algorithms: the only file, beside the loops of each, that reads the built-in laws.
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "core/scene_keys.h"
#include "core/stabiliser/algorithm_files.h"
#include "core/stabiliser/algorithm_list.h"
#include "core/stabiliser/law_numbers.h"
#include "core/stabiliser/plugin/plugin_list.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall {
namespace {

#define HAPTICWALL_DESCRIPTION(Law) scalar::Law::kDescription,
constexpr std::array kAlgorithms{HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_DESCRIPTION)};
#undef HAPTICWALL_DESCRIPTION

template <class Law>
LawNumbers parameters_of(const StabiliserContext& context) {
  return to_numbers(Law::parameters(context));
}

template <class Law>
double step_of(Stabiliser& stabiliser, const StabiliserInput& input) {
  InlinedLaw<Law> law(stabiliser.parameters(), stabiliser.state(), stabiliser.walls());
  const double force_n = law.step(input);
  stabiliser.state() = law.state();
  return force_n;
}

double step_of_plugin(Stabiliser& stabiliser, const StabiliserInput& input) {
  return stabiliser.plugin().step(input);
}

struct LawFunctions {
  LawNumbers (*parameters)(const StabiliserContext& context);
  double (*step)(Stabiliser& stabiliser, const StabiliserInput& input);
};
#define HAPTICWALL_FUNCTIONS(Law) LawFunctions{parameters_of<scalar::Law>, step_of<scalar::Law>},
constexpr std::array kFunctions{HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_FUNCTIONS)};
#undef HAPTICWALL_FUNCTIONS

struct ParameterUnion {
  std::array<ParameterDescription, kMaxAlgorithmParameters> parameters{};
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

// Changes only while plug-ins are loaded, before other threads start.
struct AlgorithmList {
  std::vector<AlgorithmDescription> algorithms{kAlgorithms.begin(), kAlgorithms.end()};
  std::vector<ParameterDescription> parameters{
      kParameterUnion.parameters.begin(),
      kParameterUnion.parameters.begin() + static_cast<std::ptrdiff_t>(kParameterUnion.count)};
};

AlgorithmList& algorithm_list() {
  static AlgorithmList list;
  return list;
}

}  // namespace

std::span<const AlgorithmDescription> algorithms() { return algorithm_list().algorithms; }

std::size_t first_plugin() { return kAlgorithms.size(); }

std::size_t add_algorithm(const AlgorithmDescription& algorithm) {
  AlgorithmList& list = algorithm_list();
  for (const ParameterDescription& parameter : algorithm.parameters) {
    if (!find_algorithm_parameter(parameter.key)) list.parameters.push_back(parameter);
  }
  list.algorithms.push_back(algorithm);
  return list.algorithms.size() - 1;
}

std::optional<std::size_t> find_algorithm(std::string_view name) {
  const auto all = algorithms();
  const auto found = std::ranges::find_if(all, [&](const auto& algorithm) {
    return !name.empty() && (algorithm.name == name || algorithm.old_name == name);
  });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(all.begin(), found));
}

std::span<const ParameterDescription> algorithm_parameters() { return algorithm_list().parameters; }

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

std::size_t follower_index() { return *find_algorithm(kFollowers.back()); }

bool has_follower(const AlgorithmSettings& settings) {
  const StabiliserContext context{.walls = {}, .settings = &settings};
  return context.value_or(kThenParameter.key, 0.0) != 0.0;
}

std::string algorithm_label(const AlgorithmSettings& settings) {
  std::string label(algorithms()[settings.index].name);
  if (has_follower(settings)) label += " then " + std::string(kFollowers.back());
  return label;
}

std::vector<ComparedAlgorithm> compared_algorithms(AlgorithmSettings settings,
                                                   std::span<const std::size_t> indices) {
  std::vector<ComparedAlgorithm> rows;
  for (const std::size_t index : indices) {
    settings.index = index;
    const auto key = find_algorithm_parameter(algorithms()[index].forms_key);
    if (!key) {
      rows.push_back({settings, algorithm_label(settings)});
      continue;
    }
    const std::span<const std::string_view> forms = algorithm_parameters()[*key].choices;
    for (std::size_t form = 0; form < forms.size(); ++form) {
      const auto value = static_cast<double>(form);
      if (settings.values.at(*key).value_or(value) != value) continue;
      ComparedAlgorithm row{settings, algorithm_label(settings)};
      row.settings.values.at(*key) = value;
      if (form > 0) row.label += " (" + std::string(forms[form]) + ")";
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

void Stabiliser::configure(std::size_t algorithm, const StabiliserContext& context) {
  const hw_plugin* const plugin = plugin_at(algorithm);
  if (plugin == nullptr && algorithm >= kFunctions.size()) algorithm = 0;
  if (algorithm != algorithm_) reset();
  algorithm_ = algorithm;
  plugin_.configure(plugin, context);
  step_ = plugin != nullptr ? step_of_plugin : kFunctions[algorithm].step;
  parameters_ = plugin != nullptr ? LawNumbers{} : kFunctions[algorithm].parameters(context);
  walls_ = context.walls;
}

bool reads(const AlgorithmSettings& settings, std::string_view key) {
  const auto has_key = [key](const AlgorithmDescription& algorithm) {
    return std::ranges::any_of(algorithm.parameters, [key](const ParameterDescription& parameter) {
      return parameter.key == key;
    });
  };
  return key == kThenParameter.key || has_key(algorithms()[settings.index]) ||
         (has_follower(settings) && has_key(algorithms()[follower_index()]));
}

std::string value_text(const ParameterDescription& parameter, double value) {
  if (parameter.kind == ParameterKind::kBoolean) return value != 0.0 ? "true" : "false";
  if (parameter.kind == ParameterKind::kChoice) {
    return std::string(parameter.choices[static_cast<std::size_t>(value)]);
  }
  return number_text(value);
}

}  // namespace hapticwall
