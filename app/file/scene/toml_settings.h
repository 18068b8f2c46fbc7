// The settings file of earlier versions, which was TOML.
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace hapticwall::file {

// The settings as the text of a JSON object of tables. Fails if the text is not TOML; `origin`
// names it in the message.
[[nodiscard]] Result<std::string> json_of_toml_settings(std::string_view toml,
                                                        const std::string& origin);

}  // namespace hapticwall::file
