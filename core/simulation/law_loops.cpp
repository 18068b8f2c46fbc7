#include "core/simulation/law_loops.h"

#include <array>

#include "core/stabiliser/algorithm_list.h"

namespace hapticwall {

#define HAPTICWALL_DECLARE(Law) extern const LawLoops k##Law##Loops;
HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_DECLARE)
#undef HAPTICWALL_DECLARE

const LawLoops& law_loops(std::size_t algorithm) {
#define HAPTICWALL_ADDRESS(Law) &k##Law##Loops,
  static constexpr std::array kAll{HAPTICWALL_EACH_ALGORITHM(HAPTICWALL_ADDRESS)};
#undef HAPTICWALL_ADDRESS
  return *kAll[algorithm];
}

}  // namespace hapticwall
