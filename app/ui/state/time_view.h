// The part of the session that the plots show.
#pragma once

#include <array>
#include <optional>

#include "app/draw/plot/plot.h"

namespace hapticwall::ui {

// Lengths of the time window, in s.
inline constexpr std::array kTimeWindowsS{0.05, 0.1, 0.2,  0.5,  1.0,   2.0,   4.0,
                                          6.0,  8.0, 10.0, 60.0, 600.0, 3600.0};

struct TimeView {
  double window_s = 6.0;              // chosen length; stored in the settings file
  bool follow = true;                 // the plots follow the newest samples
  std::optional<double> looked_at_s;  // the moment that the views show; empty: the newest
  double from_s = 0.0;
  double to_s = 0.0;
};

// The time axes of the plots.
[[nodiscard]] inline draw::TimeWindow time_window(const TimeView& time) {
  return {time.from_s, time.to_s};
}

}  // namespace hapticwall::ui
