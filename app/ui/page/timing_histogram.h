// A histogram of times, both axes logarithmic, with its quantiles as lines.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>

#include "app/draw/plot/theme.h"
#include "app/session/loop/latency_histogram.h"

namespace hapticwall::ui {

// "850 ns", "14.2 µs", "1.34 ms", "2 s": three significant digits.
[[nodiscard]] std::string time_text(std::int64_t time_ns);

struct TimingHistogram {
  const char* title;
  const char* meaning;  // tooltip of the title
  const session::LatencyCounts* counts;
  session::Quantiles quantiles;
  std::int64_t period_ns;  // latency beyond it misses a tick
  draw::Tone tone;
};

// Draws heading and plot into `size`. Each bar has a tooltip.
void draw_timing_histogram(const draw::Theme& theme, const TimingHistogram& histogram, ImVec2 size);

}  // namespace hapticwall::ui
