#include "core/stabiliser/plugin/plugin_list.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <vector>

#include "core/stabiliser/plugin/include/hapticwall/plugin.h"
#include "core/stabiliser/plugin/plugin_law.h"
#include "core/stabiliser/stabiliser.h"

namespace hapticwall {
namespace {

struct LoadedPlugin {
  const hw_plugin* plugin = nullptr;
  // Views of the list of algorithms point into these.
  std::deque<std::string> defaults{};
  std::vector<ParameterDescription> parameters{};
  std::vector<SignalDescription> signals{};
  std::atomic<bool> thrown = false;
};

std::deque<LoadedPlugin>& loaded_plugins() {
  static std::deque<LoadedPlugin> plugins;
  return plugins;
}

ParameterDescription described(const hw_parameter& parameter, std::deque<std::string>& defaults) {
  const bool chosen = std::isnan(parameter.fallback);
  defaults.push_back(chosen ? "the plug-in's choice" : value_text({}, parameter.fallback));
  return number_parameter(parameter.key, parameter.unit, parameter.minimum, parameter.maximum,
                          defaults.back(), parameter.meaning);
}

}  // namespace

std::size_t add_plugin(const hw_plugin& plugin) {
  LoadedPlugin& loaded = loaded_plugins().emplace_back();
  loaded.plugin = &plugin;
  for (std::size_t i = 0; i < plugin.parameter_count; ++i)
    loaded.parameters.push_back(described(plugin.parameters[i], loaded.defaults));
  for (std::size_t i = 0; i < plugin.signal_count; ++i)
    loaded.signals.push_back({plugin.signals[i].name, plugin.signals[i].meaning});
  return add_algorithm(
      {plugin.name, plugin.title, plugin.idea, loaded.parameters, plugin.equation, loaded.signals});
}

const hw_plugin* plugin_at(std::size_t algorithm) {
  if (algorithm < first_plugin() || algorithm >= algorithms().size()) return nullptr;
  return loaded_plugins()[algorithm - first_plugin()].plugin;
}

std::size_t largest_plugin_state() {
  std::size_t largest = 0;
  for (const LoadedPlugin& loaded : loaded_plugins())
    largest = std::max<std::size_t>(largest, loaded.plugin->state_bytes);
  return largest;
}

void note_plugin_exception(const hw_plugin& plugin) {
  for (LoadedPlugin& loaded : loaded_plugins()) {
    if (loaded.plugin == &plugin) loaded.thrown = true;
  }
}

bool plugin_has_thrown(std::size_t algorithm) {
  return plugin_at(algorithm) != nullptr && loaded_plugins()[algorithm - first_plugin()].thrown;
}

}  // namespace hapticwall
