#include "app/file/scene/settings_text.h"

#include <cmath>
#include <optional>

#include "app/file/scene/table_reader.h"
#include "app/file/scene/toml_text.h"
#include "core/text.h"

namespace hapticwall::file {
namespace {

std::optional<SettingValue> value_of(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return SettingValue(**flag);
  if (const auto* text = node.as_string()) return SettingValue(**text);
  if (const auto* integer = node.as_integer()) return SettingValue(static_cast<double>(**integer));
  const auto* real = node.as_floating_point();
  if (real == nullptr || !std::isfinite(**real)) return std::nullopt;
  return SettingValue(**real);
}

// A path may hold any bytes; TOML takes UTF-8 only.
bool can_be_written(const SettingValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr || is_utf8(*text);
}

void write_value(TomlText& out, const std::string& key, const SettingValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) {
    out.boolean(key, *flag);
  } else if (const double* number = std::get_if<double>(&value)) {
    out.number(key, *number);
  } else {
    out.string(key, std::get<std::string>(value));
  }
}

}  // namespace

Result<Settings> parse_settings(std::string_view text, const std::string& origin) {
  Settings settings;
  try {
    const toml::table root = parse_toml(text, origin, "settings file");
    for (const auto& [table_key, node] : root) {
      const toml::table* table = node.as_table();
      if (table == nullptr) continue;
      for (const auto& [key, value_node] : *table) {
        if (auto value = value_of(value_node)) {
          settings.insert_or_assign(std::string(table_key.str()) + "." + std::string(key.str()),
                                    std::move(*value));
        }
      }
    }
  } catch (const ReadFailure& failure) {
    return usage_error(failure.what());
  }
  return settings;
}

std::string settings_text(const Settings& settings) {
  TomlText out;
  out.comment("Haptic Wall: settings of the window. Written by the program; may be deleted.");
  std::string_view open_table;
  for (const auto& [key, value] : settings) {
    if (!can_be_written(value)) continue;
    const std::size_t point = key.find('.');
    const std::string_view table = std::string_view(key).substr(0, point);
    if (table != open_table) out.table(table);
    open_table = table;
    write_value(out, key.substr(point + 1), value);
  }
  return out.text();
}

}  // namespace hapticwall::file
