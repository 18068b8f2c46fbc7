// What comes of every key, a row for each line of the help.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/window/person.h"

namespace hapticwall::test {

struct KeyRow {
  std::string what;  // as the help says
  // Presses the key, and says what comes of it.
  std::function<void(Person&, const std::function<void()>& press)> check;
};

// On the simulator.
[[nodiscard]] std::vector<KeyRow> key_rows();

}  // namespace hapticwall::test
