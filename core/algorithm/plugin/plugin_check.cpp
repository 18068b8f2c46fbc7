#include "core/algorithm/plugin/plugin_check.h"

#include <algorithm>
#include <cmath>

#include "core/algorithm/plugin/plugin_algorithm.h"
#include "core/scene_keys.h"
#include "core/text.h"

namespace hapticwall {
namespace {

constexpr std::size_t kMaxTextBytes = 200;
constexpr std::string_view kLettersAndDigits = "abcdefghijklmnopqrstuvwxyz0123456789";

bool has_key_twice(const PluginParameters& parameters, std::size_t index) {
  for (std::size_t i = 0; i < index; ++i) {
    if (parameters.first[i].key == std::string_view(parameters.first[index].key)) return true;
  }
  return false;
}

std::string parameter_problem(const hw_parameter& parameter, const KnownParameters& known,
                              std::size_t& new_keys) {
  if (!is_plugin_line(parameter.unit) || !is_plugin_line(parameter.meaning))
    return "unit and meaning must be one line of UTF-8 each, of at most 200 bytes";
  if (std::string problem = range_problem(parameter); !problem.empty()) return problem;
  const std::string kind(known.kind);
  const auto other = std::ranges::find(known.parameters, parameter.key, &ParameterDescription::key);
  if (other == known.parameters.end()) {
    if (known.parameters.size() + ++new_keys <= known.max) return "";
    return "the " + kind + "s together have more than " + std::to_string(known.max) + " keys";
  }
  const bool same = other->kind == ParameterKind::kNumber && other->unit == parameter.unit &&
                    other->minimum == parameter.minimum && other->maximum == parameter.maximum;
  return same ? "" : "another " + kind + " has this key with another unit, minimum or maximum";
}

}  // namespace

bool is_plugin_word(const char* text, char joint) {
  const std::string_view word = text == nullptr ? "" : text;
  return !word.empty() && word.size() <= kMaxTextBytes &&
         word.find_first_not_of(std::string(kLettersAndDigits) + joint) == std::string_view::npos;
}

bool is_plugin_line(const char* text) {
  if (text == nullptr) return false;
  const std::string_view line = text;
  if (line.size() > kMaxTextBytes || !is_utf8(line)) return false;
  for (std::size_t i = 0; i < line.size(); i += utf8_length(line.substr(i))) {
    if (starts_with_control(line.substr(i))) return false;
  }
  return true;
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

std::string parameters_problem(const PluginParameters& parameters, const KnownParameters& known) {
  if (parameters.count > kMaxPluginParameters)
    return std::to_string(parameters.count) + " parameters; at most " +
           std::to_string(kMaxPluginParameters) + " are taken";
  if (parameters.count > 0 && parameters.first == nullptr) return "parameters is NULL";
  std::size_t new_keys = 0;
  for (std::size_t i = 0; i < parameters.count; ++i) {
    const char* const key = parameters.first[i].key;
    if (!is_plugin_word(key, '_'))
      return "the key of parameter " + std::to_string(i) + " is not a word of a-z, 0-9 and _";
    std::string problem = has_key_twice(parameters, i)
                              ? "the plug-in has this key twice"
                              : parameter_problem(parameters.first[i], known, new_keys);
    if (!problem.empty()) return "parameter " + std::string(key) + ": " + problem;
  }
  return "";
}

}  // namespace hapticwall
