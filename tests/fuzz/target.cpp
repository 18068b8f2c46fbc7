#include "tests/fuzz/target.h"

#include <string>

namespace hapticwall::fuzz {

void require(bool holds, std::string_view promise) {
  if (!holds) throw BrokenPromise("broken promise: " + std::string(promise));
}

std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

}  // namespace hapticwall::fuzz
