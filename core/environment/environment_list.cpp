// The list of environments: the only file that reads the built-in ones.
#include <algorithm>
#include <array>
#include <iterator>

#include "core/environment/bump.h"
#include "core/environment/detents.h"
#include "core/environment/environment.h"
#include "core/environment/hunt_crossley.h"
#include "core/environment/virtual_mass.h"
#include "core/sample.h"

namespace hapticwall {
namespace {

constexpr Environment kWalls{{"walls",
                              "Walls",
                              "the walls of the scene, springs with dampers",
                              {},
                              "F_e = Σ max(0, K p + B v)  where p > 0, else 0"}};

// In the order of menus, files and tables. The first one is the default.
constexpr std::array kEnvironments{
    kWalls,
    environment_of<HuntCrossley>(),
    environment_of<Detents>(),
    environment_of<VirtualMass>(),
    environment_of<Bump>(),
};

constexpr auto kEnvironmentParameters = unite_parameters<kMaxEnvironmentParameters>(kEnvironments);
constexpr auto kEnvironmentSignals = unite_signals<kMaxSignals>(kEnvironments);

// Changes only while plug-ins are loaded, before other threads start. `all` never moves its
// members: servos point to them.
struct EnvironmentList {
  EnvironmentList() {
    all.reserve(kMaxEnvironments);
    all.assign(kEnvironments.begin(), kEnvironments.end());
  }
  std::vector<Environment> all;
  std::vector<ParameterDescription> parameters{kEnvironmentParameters.in_use().begin(),
                                               kEnvironmentParameters.in_use().end()};
};

EnvironmentList& environment_list() {
  static EnvironmentList list;
  return list;
}

}  // namespace

const std::vector<Environment>& environments() { return environment_list().all; }

std::span<const SignalDescription> environment_signals() { return kEnvironmentSignals.in_use(); }

std::span<const ParameterDescription> environment_parameters() {
  return environment_list().parameters;
}

std::optional<std::size_t> find_environment(std::string_view name) {
  const auto& all = environments();
  const auto found = std::ranges::find_if(
      all, [&](const Environment& environment) { return environment.description.name == name; });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(std::distance(all.begin(), found));
}

const Environment* chosen_environment(const EnvironmentSettings& settings) {
  if (settings.is_walls() || settings.index >= environments().size()) return nullptr;
  return &environments()[settings.index];
}

std::size_t add_environment(const Environment& environment) {
  EnvironmentList& list = environment_list();
  for (const ParameterDescription& parameter : environment.description.parameters) {
    const auto same = [&](const auto& known) { return known.key == parameter.key; };
    if (std::ranges::none_of(list.parameters, same)) list.parameters.push_back(parameter);
  }
  list.all.push_back(environment);
  return list.all.size() - 1;
}

std::optional<double> EnvironmentContext::value(std::string_view key) const {
  if (settings == nullptr) return std::nullopt;
  return find_value(environment_parameters(), settings->values, key);
}

}  // namespace hapticwall
