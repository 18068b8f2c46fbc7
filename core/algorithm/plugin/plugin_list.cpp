#include "core/algorithm/plugin/plugin_list.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <deque>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_algorithm.h"

namespace hapticwall {
namespace {

struct LoadedPlugin {
  // All but the first `count` are null.
  std::array<std::atomic<const hw_plugin*>, kMaxPluginRevisions> revisions{};
  std::atomic<std::uint32_t> count = 0;
  // Views of the list of algorithms point into these.
  std::deque<std::string> defaults{};
  std::vector<ParameterDescription> parameters{};
  std::vector<SignalDescription> signals{};
  std::atomic<LibraryFault> fault = LibraryFault::kNone;
};

std::deque<LoadedPlugin>& loaded_plugins() {
  static std::deque<LoadedPlugin> plugins;
  return plugins;
}

void add_revision(LoadedPlugin& loaded, const hw_plugin& plugin) {
  const std::uint32_t count = loaded.count.load(std::memory_order_relaxed);
  loaded.revisions.at(count).store(&plugin, std::memory_order_relaxed);
  loaded.count.store(count + 1, std::memory_order_release);
}

// The plug-in of an index; null for a built-in algorithm.
LoadedPlugin* loaded_plugin(std::size_t algorithm) {
  if (algorithm < first_plugin() || algorithm >= algorithms().size()) return nullptr;
  return &loaded_plugins()[algorithm - first_plugin()];
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
  add_revision(loaded, plugin);
  for (std::size_t i = 0; i < plugin.parameter_count; ++i)
    loaded.parameters.push_back(described(plugin.parameters[i], loaded.defaults));
  for (std::size_t i = 0; i < plugin.signal_count; ++i)
    loaded.signals.push_back({plugin.signals[i].name, plugin.signals[i].meaning});
  return add_algorithm(
      {plugin.name, plugin.title, plugin.idea, loaded.parameters, plugin.equation, loaded.signals});
}

void replace_plugin(std::size_t algorithm, const hw_plugin& newer) {
  add_revision(*loaded_plugin(algorithm), newer);
}

const hw_plugin* plugin_at(std::size_t algorithm, std::uint32_t revision) {
  const LoadedPlugin* const loaded = loaded_plugin(algorithm);
  if (loaded == nullptr) return nullptr;
  const std::uint32_t newest = loaded->count.load(std::memory_order_acquire);
  const std::uint32_t wanted = revision == 0 ? newest : std::min(revision, newest);
  return loaded->revisions.at(wanted - 1).load(std::memory_order_relaxed);
}

std::uint32_t plugin_revision(std::size_t algorithm) {
  const LoadedPlugin* const loaded = loaded_plugin(algorithm);
  return loaded == nullptr ? 0 : loaded->count.load(std::memory_order_acquire);
}

std::size_t plugin_state_capacity() {
  constexpr std::size_t kMinBytes = 4096;
  std::size_t largest = 0;
  for (const LoadedPlugin& loaded : loaded_plugins())
    largest = std::max<std::size_t>(largest, loaded.revisions.front().load()->state_bytes);
  return loaded_plugins().empty() ? 0 : std::max(2 * largest, kMinBytes);
}

void note_plugin_fault(const hw_plugin& plugin, LibraryFault fault) {
  for (LoadedPlugin& loaded : loaded_plugins()) {
    const auto first = loaded.revisions.begin();
    const auto last = first + loaded.count.load(std::memory_order_acquire);
    if (std::find(first, last, &plugin) != last) loaded.fault = fault;
  }
}

LibraryFault plugin_fault(std::size_t algorithm) {
  const LoadedPlugin* const loaded = loaded_plugin(algorithm);
  return loaded == nullptr ? LibraryFault::kNone : loaded->fault.load();
}

}  // namespace hapticwall
