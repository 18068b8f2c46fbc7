#include "app/file/scene/toml_settings.h"

#include <sstream>

#include "app/file/scene/table_reader.h"

namespace hapticwall::file {

Result<std::string> json_of_toml_settings(std::string_view toml, const std::string& origin) {
  try {
    const toml::table root = parse_toml(toml, origin, "settings file");
    std::ostringstream json;
    json << toml::json_formatter(root);
    return json.str();
  } catch (const ReadFailure& failure) {
    return usage_error(failure.what());
  }
}

}  // namespace hapticwall::file
