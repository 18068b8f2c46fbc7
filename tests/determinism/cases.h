// Results that the program computes, each as the arguments with which `hapticwall` writes the same
// bytes.
#pragma once

#include <string>
#include <vector>

namespace hapticwall::determinism {

struct Case {
  std::string arguments;  // "run press --algorithm none": its --csv has these bytes
  std::string sha256;
};

// Every built-in scene under every algorithm; every integrator, and the parts of a scene that the
// built-in ones leave out; a map on 1, 2 and 5 threads. Throws std::runtime_error where a scene is
// not one.
[[nodiscard]] std::vector<Case> compute_cases();

}  // namespace hapticwall::determinism
