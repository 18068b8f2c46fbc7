#include "app/study/algorithm_names.h"

#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::study {

std::vector<std::size_t> algorithms_of(std::string_view names) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; names.empty() && i < algorithms().size(); ++i) indices.push_back(i);
  if (names.empty()) return indices;
  for (const std::string_view name : file::split(names, ','))
    indices.push_back(*find_algorithm(name));
  return indices;
}

std::string wrong_algorithms(std::string_view names) {
  if (names.empty()) return "";
  for (const std::string_view name : file::split(names, ',')) {
    if (!find_algorithm(name)) return "it takes names of algorithms, separated by commas";
  }
  return "";
}

}  // namespace hapticwall::study
