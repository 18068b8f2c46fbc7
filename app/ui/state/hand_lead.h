// Turns the events of a pointer into moves of the hand. Between two events the hand follows the
// straight line, one frame late, so that it never waits for the next event of a steady pointer.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "app/session/loop/led_hand.h"

namespace hapticwall::ui {

// Events that arrive together have one place in time: the window system delivers them in bursts.
inline constexpr double kBurstS = 0.002;
// A pointer that is silent for longer rests, unless frames take longer. The line after a rest takes
// this long.
inline constexpr double kRestS = 0.1;

class HandLead {
 public:
  // A place that the pointer points at, m, on any monotonic clock.
  struct Point {
    double time_s = 0.0;
    glm::dvec2 place_m{};
  };

  // The button goes down. The hand moves only as the pointer does from here on.
  void grab(const Point& here);
  [[nodiscard]] bool holds() const { return sent_.has_value(); }
  // An event, in order of time.
  void follow(const Point& to);
  // Moves for the events since the last call; call it once a frame.
  [[nodiscard]] std::vector<session::HandMove> take(double now_s);
  void release() { sent_.reset(); }

 private:
  [[nodiscard]] session::HandMove line_to(const Point& to, double frame_s);

  std::optional<Point> sent_;  // end of the newest move
  std::vector<Point> points_;  // not sent yet
  double burst_s_ = 0.0;       // begin of the newest burst
  double frame_s_ = 0.0;       // time of the newest frame
  double arrival_s_ = 0.0;     // when the hand gets to `sent_`
  bool grabbed_ = false;       // grabbed in this frame
};

}  // namespace hapticwall::ui
