// Settings of the program as TOML: tables of plain values, all of them optional.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "core/result.h"

namespace hapticwall::file {

using SettingValue = std::variant<bool, double, std::string>;
// By "table.key". Arrays, dates and nested tables are ignored.
using Settings = std::map<std::string, SettingValue, std::less<>>;

inline constexpr std::size_t kMaxSettingsBytes = 256U << 10U;

// Fails if the text is not TOML; `origin` names it in the message. Ignores numbers that are not
// finite.
[[nodiscard]] Result<Settings> parse_settings(std::string_view text, const std::string& origin);

// Omits texts that are not UTF-8. Precondition: every key contains a point.
[[nodiscard]] std::string settings_text(const Settings& settings);

}  // namespace hapticwall::file
