// Timing of the loop and of the window.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "app/session/live_session.h"
#include "app/session/loop/latency_histogram.h"

namespace hapticwall::ui {

// Drawing times of the newest frames, ms.
class FrameTimes {
 public:
  static constexpr std::size_t kKept = 600;
  using Series = std::array<double, kKept>;

  void add(double time_s);
  void clear() { added_ = 0; }

  [[nodiscard]] std::size_t size() const { return added_ < kKept ? added_ : kKept; }
  // Oldest first; returns the filled part of `out`.
  std::span<const double> copy_ms(Series& out) const;

 private:
  Series times_ms_{};
  std::size_t added_ = 0;
};

// All 0 when there are no frames.
struct FrameStats {
  double mean_ms = 0.0;
  double p99_ms = 0.0;
  double maximum_ms = 0.0;
};
[[nodiscard]] FrameStats frame_stats(const FrameTimes& frames);

// Counters of a session at one moment.
struct TimingCounters {
  session::TimingHistograms histograms;
  std::uint64_t ticks = 0;
  std::uint64_t missed_ticks = 0;
  std::uint64_t plot_drops = 0;
};

// When the loop last answered, by the window's clock.
struct LoopAnswer {
  std::uint64_t cycles = 0;
  double newest_s = 0.0;
  double silent_s = 0.0;  // 0: it answers
};
// The loop is silent after this time without a new cycle, or after three periods if that is longer.
inline constexpr double kMaxLoopSilenceS = 0.1;

// Lives as long as the window.
struct TimingState {
  LoopAnswer answer;
  TimingCounters cleared;  // when the user last cleared the page; zeros: never
  // Counts in this frame, since `cleared`.
  TimingCounters shown;
  session::Quantiles wake_latency;
  session::Quantiles compute_time;
  FrameTimes frames;
  bool clear_asked = false;  // clears from the next frame on
  bool page_seen = false;    // the page was visible in the last frame

  [[nodiscard]] bool since_start() const { return cleared.histograms.wake_latency.total() == 0; }
};

// Called once a frame, before anything shows it. Another session starts at zero again. `live`: null
// where there is no loop, and all counts are 0.
void note_timing(TimingState& state, const session::LiveSession* live,
                 const session::TimingStatistics& timing);

// Notes the loop's answer. Called once a frame, before note_timing(). `snapshot` of a loop that
// runs, or nullptr.
void note_answer(LoopAnswer& answer, const session::Snapshot* snapshot, double period_s,
                 double now_s);
// "the loop has not answered for 1.2 s"; empty if it answers.
[[nodiscard]] std::string silence_text(const LoopAnswer& answer);

}  // namespace hapticwall::ui
