// Checks of texts and parameters that plug-ins of every kind share.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/parameter.h"

namespace hapticwall {

// True for a text of a-z, 0-9 and `joint`, of 1 to 200 bytes.
[[nodiscard]] bool is_plugin_word(const char* text, char joint);
// True for one line of UTF-8, of at most 200 bytes; it may be empty.
[[nodiscard]] bool is_plugin_line(const char* text);

// The keys that are there already, the limit of all, and the kind: "algorithm".
struct KnownParameters {
  std::span<const ParameterDescription> parameters;
  std::size_t max = 0;
  std::string_view kind;
};
struct PluginParameters {
  const hw_parameter* first = nullptr;
  std::uint32_t count = 0;
};
// The first problem of a plug-in's keys, or "".
[[nodiscard]] std::string parameters_problem(const PluginParameters& parameters,
                                             const KnownParameters& known);
// A problem of a number's range and fallback, or "".
[[nodiscard]] std::string range_problem(const hw_parameter& parameter);

}  // namespace hapticwall
