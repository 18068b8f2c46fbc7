// KEY=LO:HI:N[:log], an axis of a map.
#pragma once

#include <string>

#include "core/result.h"
#include "core/study/stability_map.h"

namespace hapticwall::command {

// `option`: "--x", for messages. KEY must be a number of the scene.
[[nodiscard]] Result<MapAxis> parse_map_axis(const std::string& option, const std::string& text,
                                             const Scene& scene);

}  // namespace hapticwall::command
