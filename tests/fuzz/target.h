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

// What became of an input. Both are right, as long as every promise was kept.
enum class Outcome : std::uint8_t { kTaken, kRefused };

struct Target {
  std::string_view name;
  Outcome (*fuzz_one)(Bytes input);
};

// All that are linked in.
[[nodiscard]] std::vector<Target>& targets();

// At namespace scope of a target's file: puts it among the targets.
class Registered {
 public:
  explicit Registered(const Target& target) { targets().push_back(target); }
};

// The bytes as text.
[[nodiscard]] inline std::string_view text_of(Bytes input) {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}

}  // namespace hapticwall::fuzz
