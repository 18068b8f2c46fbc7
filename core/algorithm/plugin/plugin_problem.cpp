// Problems for which the program refuses a plug-in.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_algorithm.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/scene_keys.h"
#include "core/text.h"

namespace hapticwall {
namespace {

constexpr std::size_t kMaxTextBytes = 200;
constexpr std::string_view kLettersAndDigits = "abcdefghijklmnopqrstuvwxyz0123456789";

bool is_word(const char* text, char joint) {
  const std::string_view word = text == nullptr ? "" : text;
  return !word.empty() && word.size() <= kMaxTextBytes &&
         word.find_first_not_of(std::string(kLettersAndDigits) + joint) == std::string_view::npos;
}

bool is_line(const char* text) {
  if (text == nullptr) return false;
  const std::string_view line = text;
  if (line.size() > kMaxTextBytes || !is_utf8(line)) return false;
  for (std::size_t i = 0; i < line.size(); i += utf8_length(line.substr(i))) {
    if (starts_with_control(line.substr(i))) return false;
  }
  return true;
}

std::string texts_problem(const hw_plugin& plugin) {
  if (!is_word(plugin.name, '-')) return "its name is not a word of a-z, 0-9 and -";
  if (find_algorithm(plugin.name))
    return "an algorithm is called \"" + std::string(plugin.name) + "\" already";
  if (!is_line(plugin.title) || !is_line(plugin.idea) || !is_line(plugin.equation))
    return "title, idea and equation must be one line of UTF-8 each, of at most 200 bytes";
  return "";
}

std::string range_problem(const hw_parameter& parameter) {
  const ValueRange range{parameter.minimum, parameter.maximum};
  if (!std::isfinite(range.minimum) || !std::isfinite(range.maximum) ||
      range.minimum >= range.maximum) {
    return "minimum and maximum must be finite, and minimum the smaller one";
  }
  if (std::isnan(parameter.fallback) || range.contains(parameter.fallback)) return "";
  return "fallback " + number_text(parameter.fallback) + " is outside " +
         number_text(range.minimum) + " to " + number_text(range.maximum);
}

std::string parameter_problem(const hw_parameter& parameter, std::size_t& new_keys) {
  if (!is_line(parameter.unit) || !is_line(parameter.meaning))
    return "unit and meaning must be one line of UTF-8 each, of at most 200 bytes";
  if (std::string problem = range_problem(parameter); !problem.empty()) return problem;
  const auto known = find_algorithm_parameter(parameter.key);
  if (!known) ++new_keys;
  if (algorithm_parameters().size() + new_keys > kMaxAlgorithmParameters)
    return "the algorithms together have more than " + std::to_string(kMaxAlgorithmParameters) +
           " keys";
  if (!known) return "";
  const ParameterDescription& other = algorithm_parameters()[*known];
  const bool same = other.kind == ParameterKind::kNumber && other.unit == parameter.unit &&
                    other.minimum == parameter.minimum && other.maximum == parameter.maximum;
  return same ? "" : "another algorithm has this key with another unit, minimum or maximum";
}

std::string signal_problem(const hw_plugin& plugin, std::size_t index) {
  const std::string_view name = plugin.signals[index].name;
  if (!is_line(plugin.signals[index].meaning))
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
    if (!is_word(name, '_'))
      return "the name of signal " + std::to_string(i) + " is not a word of a-z, 0-9 and _";
    const std::string problem = signal_problem(plugin, i);
    if (!problem.empty()) return "signal " + std::string(name) + ": " + problem;
    if (!find_algorithm_signal(name)) ++all;
  }
  if (all <= kMaxSignals) return "";
  return "the algorithms together have more than " + std::to_string(kMaxSignals) + " signals";
}

bool has_key_twice(const hw_plugin& plugin, std::size_t index) {
  for (std::size_t i = 0; i < index; ++i) {
    if (plugin.parameters[i].key == std::string_view(plugin.parameters[index].key)) return true;
  }
  return false;
}

std::string parameters_problem(const hw_plugin& plugin) {
  if (plugin.parameter_count > kMaxPluginParameters)
    return std::to_string(plugin.parameter_count) + " parameters; at most " +
           std::to_string(kMaxPluginParameters) + " are taken";
  if (plugin.parameter_count > 0 && plugin.parameters == nullptr) return "parameters is NULL";
  std::size_t new_keys = 0;
  for (std::size_t i = 0; i < plugin.parameter_count; ++i) {
    const char* const key = plugin.parameters[i].key;
    if (!is_word(key, '_'))
      return "the key of parameter " + std::to_string(i) + " is not a word of a-z, 0-9 and _";
    std::string problem = has_key_twice(plugin, i)
                              ? "the plug-in has this key twice"
                              : parameter_problem(plugin.parameters[i], new_keys);
    if (!problem.empty()) return "parameter " + std::string(key) + ": " + problem;
  }
  return "";
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
                      return is_word(x.key, '_') && std::string_view(x.key) == y.key &&
                             is_line(x.unit) && std::string_view(x.unit) == y.unit &&
                             x.minimum == y.minimum && x.maximum == y.maximum &&
                             range_problem(x).empty();
                    });
}

bool same_signals(const hw_plugin& a, const hw_plugin& b) {
  if (a.signal_count != b.signal_count || (a.signal_count > 0 && a.signals == nullptr))
    return false;
  return std::equal(a.signals, a.signals + a.signal_count, b.signals,
                    [](const hw_signal& x, const hw_signal& y) {
                      return is_word(x.name, '_') && std::string_view(x.name) == y.name;
                    });
}

}  // namespace

std::string replacement_problem(const hw_plugin& newer, std::size_t algorithm) {
  const hw_plugin& older = *plugin_at(algorithm);
  if (std::string problem = interface_problem(newer); !problem.empty()) return problem;
  if (!is_word(newer.name, '-') || std::string_view(newer.name) != older.name)
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
  if (problem.empty()) problem = parameters_problem(plugin);
  return problem.empty() ? signals_problem(plugin) : problem;
}

}  // namespace hapticwall
