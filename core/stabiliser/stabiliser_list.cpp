// The list of algorithms: the only file, beside the loops of each, that reads the built-in laws.
#include <algorithm>
#include <array>
#include <cmath>
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

// The values of a law's signals.
template <class Law>
void signals_of(const LawAfterStep& law, std::span<double> values) {
  if constexpr (!Law::kDescription.signals.empty()) {
    const auto signals =
        Law::signals(from_numbers<typename Law::template Parameters<double>>(law.parameters),
                     from_numbers<typename Law::template State<double>>(law.state), law.walls,
                     law.input, law.force_n);
    static_assert(signals.size() == Law::kDescription.signals.size());
    std::ranges::copy(signals, values.begin());
  }
}

struct LawFunctions {
  LawNumbers (*parameters)(const StabiliserContext& context);
  double (*step)(Stabiliser& stabiliser, const StabiliserInput& input);
  void (*signals)(const LawAfterStep& law, std::span<double> values);
};
#define HAPTICWALL_FUNCTIONS(Law) \
  LawFunctions{parameters_of<scalar::Law>, step_of<scalar::Law>, signals_of<scalar::Law>},
constexpr std::array kFunctions{HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_FUNCTIONS)};
#undef HAPTICWALL_FUNCTIONS

// Descriptions, each name once.
template <class Description, std::size_t kMax>
struct Union {
  std::array<Description, kMax> members{};
  std::size_t count = 0;

  [[nodiscard]] constexpr std::span<const Description> in_use() const {
    return std::span(members).first(count);
  }
  constexpr void add(const Description& wanted, std::string_view Description::*name) {
    for (const Description& member : in_use()) {
      if (member.*name == wanted.*name) return;
    }
    members.at(count++) = wanted;  // too many: does not compile
  }
};

constexpr auto unite_parameters() {
  Union<ParameterDescription, kMaxAlgorithmParameters> all;
  all.add(kThenParameter, &ParameterDescription::key);
  for (const AlgorithmDescription& algorithm : kAlgorithms) {
    for (const ParameterDescription& parameter : algorithm.parameters)
      all.add(parameter, &ParameterDescription::key);
  }
  return all;
}
constexpr auto kParameterUnion = unite_parameters();

constexpr auto unite_signals() {
  Union<SignalDescription, kMaxSignals> all;
  for (const AlgorithmDescription& algorithm : kAlgorithms) {
    for (const SignalDescription& signal : algorithm.signals)
      all.add(signal, &SignalDescription::name);
  }
  return all;
}
constexpr auto kSignalUnion = unite_signals();

// By algorithm, in the order of its signals.
using SignalPlaces = std::array<std::size_t, kMaxSignals>;
constexpr auto find_signal_places() {
  std::array<SignalPlaces, kAlgorithms.size()> places{};
  for (std::size_t law = 0; law < kAlgorithms.size(); ++law) {
    for (std::size_t i = 0; i < kAlgorithms[law].signals.size(); ++i) {
      while (kSignalUnion.members[places[law][i]].name != kAlgorithms[law].signals[i].name)
        ++places[law][i];
    }
  }
  return places;
}
constexpr auto kSignalPlaces = find_signal_places();

// Changes only while plug-ins are loaded, before other threads start.
struct AlgorithmList {
  std::vector<AlgorithmDescription> algorithms{kAlgorithms.begin(), kAlgorithms.end()};
  std::vector<ParameterDescription> parameters{kParameterUnion.in_use().begin(),
                                               kParameterUnion.in_use().end()};
  std::vector<SignalDescription> signals{kSignalUnion.in_use().begin(),
                                         kSignalUnion.in_use().end()};
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
  for (const SignalDescription& signal : algorithm.signals) {
    if (!find_algorithm_signal(signal.name)) list.signals.push_back(signal);
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

std::span<const SignalDescription> algorithm_signals() { return algorithm_list().signals; }

std::optional<std::size_t> find_algorithm_signal(std::string_view name) {
  const auto all = algorithm_signals();
  const auto found = std::ranges::find(all, name, &SignalDescription::name);
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(all.begin(), found));
}

SignalNames signal_names() {
  SignalNames names;
  std::ranges::transform(algorithm_signals(), names.begin(),
                         [](const SignalDescription& signal) { return std::string(signal.name); });
  return names;
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

void show_signals(std::size_t algorithm, const LawAfterStep& law, Signals& signals) {
  if (algorithm >= kAlgorithms.size()) return;
  Signals values{};
  kFunctions[algorithm].signals(law, values);
  for (std::size_t i = 0; i < kAlgorithms[algorithm].signals.size(); ++i) {
    if (std::isfinite(values[i])) signals[kSignalPlaces[algorithm][i]] = values[i];
  }
}

void Stabiliser::configure(std::size_t algorithm, const StabiliserContext& context) {
  const std::uint32_t revision = context.settings == nullptr ? 0 : context.settings->revision;
  const hw_plugin* const plugin = plugin_at(algorithm, revision);
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
