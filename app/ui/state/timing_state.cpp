#include "app/ui/state/timing_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/units.h"

namespace hapticwall::ui {
void FrameTimes::add(double time_s) {
  times_ms_[added_ % kKept] = time_s * kMillisecondsPerSecond;
  ++added_;
}

std::span<const double> FrameTimes::copy_ms(Series& out) const {
  const std::size_t oldest = added_ - size();
  for (std::size_t i = 0; i < size(); ++i) out[i] = times_ms_[(oldest + i) % kKept];
  return std::span(out).first(size());
}

FrameStats frame_stats(const FrameTimes& frames) {
  FrameTimes::Series sorted{};
  const std::span<const double> times_ms = frames.copy_ms(sorted);
  if (times_ms.empty()) return {};
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(times_ms.size());
  std::sort(sorted.begin(), end);
  constexpr double kP99 = 0.99;
  return {std::accumulate(sorted.begin(), end, 0.0) / static_cast<double>(times_ms.size()),
          times_ms[session::nearest_rank(kP99, times_ms.size()) - 1], times_ms.back()};
}

void note_timing(TimingState& state, const session::LiveSession* live,
                 const session::TimingStatistics& timing) {
  TimingCounters now;
  now.ticks = timing.ticks;
  now.missed_ticks = timing.missed_ticks;
  if (live != nullptr) {
    live->read_timing(now.histograms);
    now.plot_drops = live->dropped_plot_samples();
  }
  const TimingCounters& cleared = state.cleared;
  const bool another_session =
      now.ticks < cleared.ticks || now.missed_ticks < cleared.missed_ticks ||
      now.plot_drops < cleared.plot_drops ||
      now.histograms.wake_latency.total() < cleared.histograms.wake_latency.total();
  if (another_session) state.cleared = {};
  if (state.clear_asked) {
    state.cleared = now;
    state.frames.clear();
    state.clear_asked = false;
  }
  state.shown.histograms.wake_latency =
      now.histograms.wake_latency.since(cleared.histograms.wake_latency);
  state.shown.histograms.compute_time =
      now.histograms.compute_time.since(cleared.histograms.compute_time);
  state.shown.ticks = now.ticks - cleared.ticks;
  state.shown.missed_ticks = now.missed_ticks - cleared.missed_ticks;
  state.shown.plot_drops = now.plot_drops - cleared.plot_drops;
  state.wake_latency = session::quantiles(state.shown.histograms.wake_latency);
  state.compute_time = session::quantiles(state.shown.histograms.compute_time);
}

void note_answer(LoopAnswer& answer, const session::Snapshot* snapshot, double period_s,
                 double now_s) {
  constexpr double kSilentPeriods = 3.0;
  if (snapshot == nullptr || snapshot->cycles != answer.cycles) {
    answer = {snapshot == nullptr ? 0 : snapshot->cycles, now_s, 0.0};
    return;
  }
  const double silent_s = now_s - answer.newest_s;
  answer.silent_s =
      silent_s > std::max(kMaxLoopSilenceS, kSilentPeriods * period_s) ? silent_s : 0.0;
}

std::string silence_text(const LoopAnswer& answer) {
  if (answer.silent_s <= 0.0) return "";
  return fmt::format("the loop has not answered for {:.1f} s", answer.silent_s);
}

}  // namespace hapticwall::ui
