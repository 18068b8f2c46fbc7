// The part of the session that the plots show.
#pragma once

#include <array>
#include <optional>

#include "app/draw/plot/plot_trigger.h"

namespace hapticwall::ui {

// Lengths of the time window, in s.
inline constexpr std::array kTimeWindowsS{0.05, 0.1, 0.2,  0.5,  1.0,   2.0,   4.0,
                                          6.0,  8.0, 10.0, 60.0, 600.0, 3600.0};

struct TimeView {
  // Stored in the settings file.
  double window_s = 6.0;       // chosen length
  bool follows_rhythm = true;  // a shorter length while a contact oscillates

  // Lives as long as the window.
  std::optional<double> rhythm_s;     // length for the present oscillation; nullopt: none
  bool follow = true;                 // the plots follow the newest samples
  std::optional<double> looked_at_s;  // the moment that the views show; empty: the newest
  double from_s = 0.0;
  double to_s = 0.0;
};

// Chooses the length for about ten periods of an oscillation; nullopt: nothing oscillates. Another
// length is chosen only when the frequency has changed by half, so that the axes stand.
void follow_rhythm(TimeView& time, std::optional<double> frequency_hz);
// The length in force.
[[nodiscard]] double window_length_s(const TimeView& time);
// Sets the time axes to the newest samples. A younger session begins at the left.
void follow_newest(TimeView& time, double newest_time_s);

// The time axes of the plots.
[[nodiscard]] inline draw::TimeWindow time_window(const TimeView& time) {
  return {time.from_s, time.to_s};
}

}  // namespace hapticwall::ui
