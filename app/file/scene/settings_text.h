// A program's settings as TOML: tables of plain values, without any of them having to be there.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "core/result.h"

namespace hapticwall::file {

using SettingValue = std::variant<bool, double, std::string>;
// By "table.key". What a file has beyond that (arrays, dates, deeper tables) is left out.
using Settings = std::map<std::string, SettingValue, std::less<>>;

inline constexpr std::size_t kLargestSettings = 256U << 10U;  // bytes

// Fails for what is not TOML; `origin` names the text in the message. Numbers that are not finite
// are left out.
[[nodiscard]] Result<Settings> parse_settings(std::string_view text, const std::string& origin);

// Reads back the same, less texts that are not UTF-8. Every key must have its point.
[[nodiscard]] std::string settings_text(const Settings& settings);

}  // namespace hapticwall::file
