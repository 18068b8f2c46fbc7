// The motion of the simulated hand that the owner leads: moves, one after another, in the time of
// the ticks.
#pragma once

#include <array>
#include <cstdint>

#include "app/session/loop/spsc_queue.h"
#include "core/plant/hand_path.h"
#include "core/sample.h"

namespace hapticwall::session {

// A straight, even motion of the hands of all axes.
struct HandMove {
  // Distance, or position if `to_place`; NaN: the axis does not move.
  std::array<double, kMaxAxes> m{};
  double duration_s = 0.0;                       // duration of a move by a distance
  double speed_m_per_s = kMaxPointerSpeedMPerS;  // for a move to a position; on the longest axis
  bool to_place = false;
  bool at_once = false;       // drops the moves before it; else it follows them
  std::uint32_t gesture = 0;  // set by the session: moves of an older gesture are dropped
};

// The loop's side. The hand follows the moves no faster than kMaxPointerSpeedMPerS (hand_path.h),
// and stays where they end. Realtime-safe: yes, every member.
class LedHand {
 public:
  using Places = std::array<double, kMaxAxes>;

  // Advances by a tick. `present_m`: the hands' intended positions, where a new gesture begins.
  void next_tick(SpscQueue<HandMove>& moves, std::uint32_t gesture, double period_s,
                 const Places& present_m);
  // True from the first move on.
  [[nodiscard]] bool leads() const { return leads_; }
  // Intended position at the end of the tick, -1 to 1 m; NaN: not led.
  [[nodiscard]] const Places& target_m() const { return target_m_; }

 private:
  bool begin_next(SpscQueue<HandMove>& moves, const Places& present_m);
  void begin(const HandMove& move, const Places& present_m);

  Places from_m_{};
  Places to_m_{};
  Places target_m_{};
  double duration_s_ = 0.0;
  double passed_s_ = 0.0;
  std::uint32_t gesture_ = 0;
  bool leads_ = false;
  bool anew_ = true;  // the next move begins at the present place
};

}  // namespace hapticwall::session
