// A fuzz target: what a reader of foreign bytes promises, held against any bytes there may be.
//
// A file NAME_target.cpp in this folder is one target, and tests/fuzz/corpus/NAME/ has its first
// inputs. `./dev fuzz` looks for inputs that break a promise (libFuzzer); fuzz_tests of every build
// replays the first inputs and their neighbours through the same function.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace hapticwall::fuzz {

using Bytes = std::span<const std::uint8_t>;

// Nobody catches it under libFuzzer: that ends the run and keeps the input.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

// Throws BrokenPromise where `promise` does not hold.
void require(bool holds, std::string_view promise);

// Outcome of an input. Both values are right if every promise was kept.
enum class Outcome : std::uint8_t { kTaken, kRefused };

struct Target {
  std::string_view name;
  Outcome (*fuzz_one)(Bytes input);
};

// All targets that are linked in.
[[nodiscard]] std::vector<Target>& targets();

// Puts a target among the targets, at namespace scope of the target's file.
class Registered {
 public:
  explicit Registered(const Target& target) { targets().push_back(target); }
};

// The bytes as text.
[[nodiscard]] inline std::string_view text_of(Bytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

}  // namespace hapticwall::fuzz
