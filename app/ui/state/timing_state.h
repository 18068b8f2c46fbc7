// What the window knows of the loop's time and of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/runtime/quantiles.h"
#include "app/runtime/session.h"

namespace hapticwall::ui {

// What the newest pictures of the window took to be made, in ms.
class FrameTimes {
 public:
  static constexpr std::size_t kKept = 600;
  using Series = std::array<double, kKept>;

  void add(double time_s);
  void clear() { added_ = 0; }

  [[nodiscard]] std::size_t size() const { return added_ < kKept ? added_ : kKept; }
  // Oldest first; returns the part of `out` that was filled.
  std::span<const double> copy_ms(Series& out) const;

 private:
  Series times_ms_{};
  std::size_t added_ = 0;
};

// Mean, and of every hundred the worst; all 0 where there are none.
struct FrameFigures {
  double mean_ms = 0.0;
  double p99_ms = 0.0;
  double maximum_ms = 0.0;
};
[[nodiscard]] FrameFigures frame_figures(const FrameTimes& frames);

// Counters of a session at one moment.
struct TimingCounters {
  runtime::TimingHistograms histograms;
  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks = 0;
  std::uint64_t plot_drops = 0;
};

// Lasts as long as the window.
struct TimingState {
  TimingCounters cleared;  // when the user last cleared the page; zeros: never
  // As they were in this frame, since then.
  TimingCounters shown;
  runtime::Quantiles wake_latency;
  runtime::Quantiles compute_time;
  FrameTimes frames;
  bool clear_asked = false;  // from the next frame on

  [[nodiscard]] bool since_start() const { return cleared.histograms.wake_latency.total() == 0; }
};

// Once a frame, before anything shows it. Another session starts at zero again.
void note_timing(TimingState& state, const runtime::Session& session,
                 const runtime::TimingStatistics& timing);

}  // namespace hapticwall::ui
