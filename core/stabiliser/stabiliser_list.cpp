// The list of algorithms: the only file that reads the built-in laws.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/scene_keys.h"
#include "core/stabiliser/energy_bounding.h"
#include "core/stabiliser/energy_bounding_2010.h"
#include "core/stabiliser/energy_limited_spring.h"
#include "core/stabiliser/force_bounding.h"
#include "core/stabiliser/half_sample.h"
#include "core/stabiliser/law.h"
#include "core/stabiliser/none.h"
#include "core/stabiliser/passivity_control.h"
#include "core/stabiliser/plugin/plugin_list.h"
#include "core/stabiliser/stabiliser.h"
#include "core/stabiliser/virtual_coupling.h"

namespace hapticwall {
namespace {

// In the order of menus, files and tables.
constexpr std::array kLaws{law_of<NoStabiliser>(),       law_of<VirtualCoupling>(),
                           law_of<PassivityControl>(),   law_of<EnergyBounding>(),
                           law_of<EnergyBounding2010>(), law_of<ForceBounding>(),
                           law_of<HalfSample>(),         law_of<EnergyLimitedSpring>()};

// Of all plug-ins: their block is a PluginLaw.
constexpr Law kPluginLaw{{},
                         [](void* /*state*/) {},
                         [](void* state, const StabiliserContext& context) {
                           static_cast<PluginLaw*>(state)->configure(context);
                         },
                         [](void* state) { static_cast<PluginLaw*>(state)->reset(); },
                         [](void* state, const StabiliserInput& in, std::span<double> signals) {
                           return static_cast<PluginLaw*>(state)->step(in, signals);
                         }};

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
  for (const Law& law : kLaws) {
    for (const ParameterDescription& parameter : law.description.parameters)
      all.add(parameter, &ParameterDescription::key);
  }
  return all;
}
constexpr auto kParameterUnion = unite_parameters();

constexpr auto unite_signals() {
  Union<SignalDescription, kMaxSignals> all;
  for (const Law& law : kLaws) {
    for (const SignalDescription& signal : law.description.signals)
      all.add(signal, &SignalDescription::name);
  }
  return all;
}
constexpr auto kSignalUnion = unite_signals();

std::vector<AlgorithmDescription> built_in() {
  std::vector<AlgorithmDescription> all;
  for (const Law& law : kLaws) all.push_back(law.description);
  return all;
}

// Changes only while plug-ins are loaded, before other threads start.
struct AlgorithmList {
  std::vector<AlgorithmDescription> algorithms = built_in();
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

std::size_t first_plugin() { return kLaws.size(); }

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

Stabiliser::Stabiliser() : law_(kLaws.data()), plugin_(std::make_unique<PluginLaw>()) {
  law_->start(block_.data());
}

void Stabiliser::borrow(const BorrowedLaw& borrowed) {
  law_ = borrowed.law;
  elsewhere_ = borrowed.state;
  signals_ = 0;
}

void Stabiliser::configure(std::size_t algorithm, const StabiliserContext& context) {
  if (borrows()) return law_->configure(elsewhere_, context);
  const std::uint32_t revision = context.settings == nullptr ? 0 : context.settings->revision;
  const hw_plugin* const plugin = plugin_at(algorithm, revision);
  if (plugin == nullptr && algorithm >= kLaws.size()) algorithm = 0;
  law_ = plugin != nullptr ? &kPluginLaw : &kLaws[algorithm];
  elsewhere_ = plugin != nullptr ? plugin_.get() : nullptr;
  plugin_->choose(plugin);
  if (algorithm != std::exchange(algorithm_, algorithm)) law_->start(block_.data());
  find_places();
  law_->configure(state(), context);
}

void Stabiliser::find_places() {
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

std::string value_text(const ParameterDescription& parameter, double value) {
  if (parameter.kind == ParameterKind::kBoolean) return value != 0.0 ? "true" : "false";
  if (parameter.kind == ParameterKind::kChoice) {
    return std::string(parameter.choices[static_cast<std::size_t>(value)]);
  }
  return number_text(value);
}

}  // namespace hapticwall
