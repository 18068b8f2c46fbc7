// A histogram of times, both axes logarithmic, with its quantiles as lines.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>

#include "app/runtime/latency_histogram.h"
#include "app/ui/theme.h"

namespace hapticwall::ui {

// "850 ns", "14.2 µs", "1.34 ms", "2 s": three digits that count.
[[nodiscard]] std::string time_text(std::int64_t time_ns);

struct TimingHistogram {
  const char* title;
  const char* meaning;  // of the title, when the pointer rests on it
  const runtime::LatencyCounts* counts;
  runtime::Quantiles quantiles;
  std::int64_t period_ns;  // what is late beyond it has missed a tick
  Tone tone;
};

// Draws heading and plot into `size`. A bar tells its figures when the pointer rests on it.
void draw_timing_histogram(const Theme& theme, const TimingHistogram& histogram, ImVec2 size);

}  // namespace hapticwall::ui
