// The closed list of algorithms. A new one is a file in this folder and a line in StabiliserTuple;
// menu, command line, scene keys, CSV metadata and `compare` follow from it.
#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

#include "core/stabiliser/energy_bookkeeping.h"
#include "core/stabiliser/energy_bounding.h"
#include "core/stabiliser/energy_bounding_2010.h"
#include "core/stabiliser/force_bounding.h"
#include "core/stabiliser/half_sample.h"
#include "core/stabiliser/none.h"
#include "core/stabiliser/passivity_control.h"
#include "core/stabiliser/stabiliser.h"
#include "core/stabiliser/virtual_coupling.h"

namespace hapticwall {

using StabiliserTuple =
    std::tuple<NoStabiliser, VirtualCoupling, PassivityControl, EnergyBounding, EnergyBounding2010,
               ForceBounding, HalfSample, EnergyBookkeeping>;

inline constexpr std::size_t kAlgorithmCount = std::tuple_size_v<StabiliserTuple>;

// One instance of every algorithm: a switch is an index. Realtime-safe: yes, all of it.
class StabiliserBank {
 public:
  void configure(const StabiliserContext& context) {
    std::apply([&](auto&... stabiliser) { (stabiliser.configure(context), ...); }, stabilisers_);
  }

  void reset() {
    std::apply([](auto&... stabiliser) { (stabiliser.reset(), ...); }, stabilisers_);
  }

  // Calls `visitor` with the algorithm at `index` (the first one where there is no such index).
  template <typename Visitor>
  decltype(auto) visit(std::size_t index, Visitor&& visitor) {
    return visit_from<0>(index, std::forward<Visitor>(visitor));
  }

 private:
  template <std::size_t I, typename Visitor>
  decltype(auto) visit_from(std::size_t index, Visitor&& visitor) {
    if constexpr (I + 1 < kAlgorithmCount) {
      if (index != I && index < kAlgorithmCount) {
        return visit_from<I + 1>(index, std::forward<Visitor>(visitor));
      }
    }
    return visitor(std::get<I>(stabilisers_));
  }

  StabiliserTuple stabilisers_;
};

}  // namespace hapticwall
