// The list of algorithms: the only file that reads the built-in algorithms.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/built_in.h"
#include "core/algorithm/energy_bounding.h"
#include "core/algorithm/energy_bounding_2010.h"
#include "core/algorithm/energy_limited_spring.h"
#include "core/algorithm/force_bounding.h"
#include "core/algorithm/half_sample.h"
#include "core/algorithm/none.h"
#include "core/algorithm/passivity_control.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/algorithm/virtual_coupling.h"
#include "core/environment/environment.h"
#include "core/scene_keys.h"

namespace hapticwall {
namespace {

// Built-in algorithms in the order of menus, files and tables.
constexpr std::array kAlgorithms{
    algorithm_of<NoAlgorithm>(),        algorithm_of<VirtualCoupling>(),
    algorithm_of<PassivityControl>(),   algorithm_of<EnergyBounding>(),
    algorithm_of<EnergyBounding2010>(), algorithm_of<ForceBounding>(),
    algorithm_of<HalfSample>(),         algorithm_of<EnergyLimitedSpring>(),
};

// Functions of all plug-ins: their block is a PluginAlgorithm.
constexpr Algorithm kPluginAlgorithm{
    {},
    [](void* /*state*/) {},
    [](void* state, const AlgorithmContext& context) {
      static_cast<PluginAlgorithm*>(state)->configure(context);
    },
    [](void* state) { static_cast<PluginAlgorithm*>(state)->reset(); },
    [](void* state, const AlgorithmInput& in, std::span<double> signals) {
      return static_cast<PluginAlgorithm*>(state)->step(in, signals);
    }};

constexpr auto with_then() {
  DescriptionUnion<ParameterDescription, kMaxAlgorithmParameters> all;
  all.add(std::span(&kThenParameter, 1), &ParameterDescription::key);
  return all;
}
constexpr auto kParameterUnion = unite_parameters(kAlgorithms, with_then());
constexpr auto kSignalUnion = unite_signals<kMaxSignals>(kAlgorithms);

std::vector<SignalDescription> all_signals() {
  DescriptionUnion<SignalDescription, kMaxSignals> all = kSignalUnion;
  all.add(environment_signals(), &SignalDescription::name);
  return {all.in_use().begin(), all.in_use().end()};
}

std::vector<AlgorithmDescription> built_in() {
  std::vector<AlgorithmDescription> all;
  all.reserve(kAlgorithms.size());
  for (const Algorithm& algorithm : kAlgorithms) all.push_back(algorithm.description);
  return all;
}

// Changes only while plug-ins are loaded, before other threads start.
struct AlgorithmList {
  std::vector<AlgorithmDescription> algorithms = built_in();
  std::vector<ParameterDescription> parameters{kParameterUnion.in_use().begin(),
                                               kParameterUnion.in_use().end()};
  std::vector<SignalDescription> signals = all_signals();
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

std::optional<double> AlgorithmContext::value(std::string_view key) const {
  if (settings == nullptr) return std::nullopt;
  return find_value(algorithm_parameters(), settings->values, key);
}

double believed_damping(const AlgorithmContext& context) {
  return context.value_or(kBelievedDampingParameter.key, context.device_damping_n_s_per_m);
}

std::size_t follower_index() { return *find_algorithm(kFollowers.back()); }

bool has_follower(const AlgorithmSettings& settings) {
  const AlgorithmContext context{.walls = {}, .settings = &settings};
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

ActiveAlgorithm::ActiveAlgorithm()
    : functions_(kAlgorithms.data()), plugin_(std::make_unique<PluginAlgorithm>()) {
  functions_->start(block_.data());
}

void ActiveAlgorithm::borrow(const BorrowedAlgorithm& borrowed) {
  functions_ = borrowed.functions;
  elsewhere_ = borrowed.state;
  signals_ = 0;
}

void ActiveAlgorithm::configure(std::size_t algorithm, const AlgorithmContext& context) {
  if (borrows()) return functions_->configure(elsewhere_, context);
  const std::uint32_t revision = context.settings == nullptr ? 0 : context.settings->revision;
  const hw_plugin* const plugin = plugin_at(algorithm, revision);
  if (plugin == nullptr && algorithm >= kAlgorithms.size()) algorithm = 0;
  functions_ = plugin != nullptr ? &kPluginAlgorithm : &kAlgorithms[algorithm];
  elsewhere_ = plugin != nullptr ? plugin_.get() : nullptr;
  plugin_->choose(plugin);
  if (algorithm != std::exchange(algorithm_, algorithm)) functions_->start(block_.data());
  find_places();
  functions_->configure(state(), context);
}

void ActiveAlgorithm::find_places() {
  const std::span<const SignalDescription> signals = algorithms()[algorithm_].signals;
  signals_ = signals.size();
  for (std::size_t i = 0; i < signals_; ++i)
    places_[i] = find_algorithm_signal(signals[i].name).value_or(kMaxSignals);
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

bool reads_other_axis(const AlgorithmSettings& settings) {
  const AlgorithmDescription& algorithm = algorithms()[settings.index];
  AlgorithmContext context;
  context.settings = &settings;
  return algorithm.reads_other_axis != nullptr && algorithm.reads_other_axis(context);
}

std::string value_text(const ParameterDescription& parameter, double value) {
  if (parameter.kind == ParameterKind::kBoolean) return value != 0.0 ? "true" : "false";
  if (parameter.kind == ParameterKind::kChoice) {
    return std::string(parameter.choices[static_cast<std::size_t>(value)]);
  }
  return number_text(value);
}

}  // namespace hapticwall
