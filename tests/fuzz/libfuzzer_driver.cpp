// Entry point of libFuzzer, for the one target that is linked in.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  hapticwall::fuzz::targets().front().fuzz_one({data, size});
  return 0;
}
