// Problems for which the program refuses a plug-in.
#include <algorithm>
#include <string_view>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_algorithm.h"
#include "core/algorithm/plugin/plugin_check.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall {
namespace {

std::string texts_problem(const hw_plugin& plugin) {
  if (!is_plugin_word(plugin.name, '-')) return "its name is not a word of a-z, 0-9 and -";
  if (find_algorithm(plugin.name))
    return "an algorithm is called \"" + std::string(plugin.name) + "\" already";
  if (!is_plugin_line(plugin.title) || !is_plugin_line(plugin.idea) ||
      !is_plugin_line(plugin.equation))
    return "title, idea and equation must be one line of UTF-8 each, of at most 200 bytes";
  return "";
}

std::string signal_problem(const hw_plugin& plugin, std::size_t index) {
  const std::string_view name = plugin.signals[index].name;
  if (!is_plugin_line(plugin.signals[index].meaning))
    return "meaning must be one line of UTF-8, of at most 200 bytes";
  for (std::size_t i = 0; i < index; ++i) {
    if (plugin.signals[i].name == name) return "the plug-in has this signal twice";
  }
  return "";
}

std::string signals_problem(const hw_plugin& plugin) {
  if (plugin.signal_count > kMaxPluginSignals)
    return std::to_string(plugin.signal_count) + " signals; at most " +
           std::to_string(kMaxPluginSignals) + " are taken";
  if (plugin.signal_count > 0 && plugin.signals == nullptr) return "signals is NULL";
  std::size_t all = algorithm_signals().size();
  for (std::size_t i = 0; i < plugin.signal_count; ++i) {
    const char* const name = plugin.signals[i].name;
    if (!is_plugin_word(name, '_'))
      return "the name of signal " + std::to_string(i) + " is not a word of a-z, 0-9 and _";
    const std::string problem = signal_problem(plugin, i);
    if (!problem.empty()) return "signal " + std::string(name) + ": " + problem;
    if (!find_algorithm_signal(name)) ++all;
  }
  if (all <= kMaxSignals) return "";
  return "the algorithms together have more than " + std::to_string(kMaxSignals) + " signals";
}

std::string interface_problem(const hw_plugin& plugin) {
  if (plugin.abi != HAPTICWALL_PLUGIN_ABI)
    return "it was built for ABI " + std::to_string(plugin.abi) + ", this program has ABI " +
           std::to_string(HAPTICWALL_PLUGIN_ABI);
  if (plugin.size != sizeof(hw_plugin))
    return "its hw_plugin has " + std::to_string(plugin.size) + " bytes, this program's has " +
           std::to_string(sizeof(hw_plugin));
  if (plugin.configure == nullptr || plugin.reset == nullptr || plugin.step == nullptr)
    return "configure, reset or step is NULL";
  if (plugin.state_bytes > kMaxPluginStateBytes)
    return "a state of " + std::to_string(plugin.state_bytes) + " bytes; at most " +
           std::to_string(kMaxPluginStateBytes) + " are taken";
  return "";
}

bool same_parameters(const hw_plugin& a, const hw_plugin& b) {
  if (a.parameter_count != b.parameter_count || (a.parameter_count > 0 && a.parameters == nullptr))
    return false;
  return std::equal(a.parameters, a.parameters + a.parameter_count, b.parameters,
                    [](const hw_parameter& x, const hw_parameter& y) {
                      return is_plugin_word(x.key, '_') && std::string_view(x.key) == y.key &&
                             is_plugin_line(x.unit) && std::string_view(x.unit) == y.unit &&
                             x.minimum == y.minimum && x.maximum == y.maximum &&
                             range_problem(x).empty();
                    });
}

bool same_signals(const hw_plugin& a, const hw_plugin& b) {
  if (a.signal_count != b.signal_count || (a.signal_count > 0 && a.signals == nullptr))
    return false;
  return std::equal(a.signals, a.signals + a.signal_count, b.signals,
                    [](const hw_signal& x, const hw_signal& y) {
                      return is_plugin_word(x.name, '_') && std::string_view(x.name) == y.name;
                    });
}

}  // namespace

std::string replacement_problem(const hw_plugin& newer, std::size_t algorithm) {
  const hw_plugin& older = *plugin_at(algorithm);
  if (std::string problem = interface_problem(newer); !problem.empty()) return problem;
  if (!is_plugin_word(newer.name, '-') || std::string_view(newer.name) != older.name)
    return "its name is not \"" + std::string(older.name) + "\" any more";
  if (!same_parameters(newer, older)) return "its parameters are not the same any more";
  if (!same_signals(newer, older)) return "its signals are not the same any more";
  if (newer.state_bytes > plugin_state_capacity())
    return "a state of " + std::to_string(newer.state_bytes) +
           " bytes; this program has room for " + std::to_string(plugin_state_capacity());
  return "";
}

std::string plugin_problem(const hw_plugin& plugin) {
  std::string problem = interface_problem(plugin);
  if (problem.empty()) problem = texts_problem(plugin);
  if (problem.empty())
    problem = parameters_problem({plugin.parameters, plugin.parameter_count},
                                 {algorithm_parameters(), kMaxAlgorithmParameters, "algorithm"});
  return problem.empty() ? signals_problem(plugin) : problem;
}

}  // namespace hapticwall
