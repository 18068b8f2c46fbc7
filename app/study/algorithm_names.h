// The option --algorithms of a study.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hapticwall::study {

// Indices in algorithms(); all without a name. Precondition: all names are known.
[[nodiscard]] std::vector<std::size_t> algorithms_of(std::string_view names);

// "" for known names, separated by commas, and for no name.
[[nodiscard]] std::string wrong_algorithms(std::string_view names);

}  // namespace hapticwall::study
