#include "app/ui/computed/tail.h"

#include <fmt/format.h>

#include "app/file/text/text.h"
#include "app/file/text/verdict.h"
#include "core/run/metrics.h"

namespace hapticwall::ui {
namespace {

using draw::Extremes;
using draw::IndexRange;
using draw::Quantity;
using draw::SampleHistory;
using file::fixed;

constexpr double kCrossed = 0.25;  // share of the extremes, on either side of their middle

// The tick after the sample before `end`.
std::uint64_t tick_at(const SampleHistory& history, std::size_t end) {
  return static_cast<std::uint64_t>(history.value(&Sample::tick, end - 1)) + 1;
}

RunStats stats_of(const SampleHistory& history, IndexRange range) {
  TickMetrics metrics(0);
  for (std::size_t i = range.first; i < range.last; ++i) {
    const auto flags = static_cast<std::uint32_t>(history.value(&Sample::flags, i));
    metrics.add(i - range.first,
                {history.value(&PlantTruth::position_m, i),
                 history.value(&Sample::penetration_m, i), history.value(&Sample::force_n, i),
                 (flags & kFlagInContact) != 0, (flags & kFlagForceLimit) != 0},
                {});
  }
  return metrics.stats();
}

// Frequency from the first to the last rise through the middle, with a hysteresis. Nullopt below
// two rises.
std::optional<double> frequency_of(const SampleHistory& history, IndexRange range,
                                   Quantity quantity, double rate_hz) {
  const Extremes all = history.extremes(quantity, range);
  const double middle = 0.5 * (all.minimum + all.maximum);
  const double margin = kCrossed * (all.maximum - all.minimum);
  bool high = true;  // the first rise needs a fall before it
  std::size_t rises = 0;
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = range.first; i < range.last; ++i) {
    const double value = history.value(quantity, i) - middle;
    if (high && value < -margin) high = false;
    if (high || value <= margin) continue;
    high = true;
    if (rises++ == 0) first = i;
    last = i;
  }
  if (rises < 2) return std::nullopt;
  return static_cast<double>(rises - 1) * rate_hz / static_cast<double>(last - first);
}

std::string movement_text(const Tail& tail) {
  if (tail.summary.verdict == Verdict::kSettled) return "quiet";
  if (tail.frequency_hz) return fixed(tail.frequency_hz, 1.0, 1) + " Hz";
  return tail.hand_moves ? "the hand moves" : "no rhythm";
}

}  // namespace

Tail tail_of(const SampleHistory& history, const Scene& scene, std::size_t end) {
  Tail tail;
  if (end == 0) return tail;
  const double rate_hz = scene.sampling.rate_hz;
  const IndexRange range{static_cast<std::size_t>(tail_begin_tick(end, rate_hz)), end};
  tail.end_tick = tick_at(history, end);
  RunEnd run_end{.ticks = range.count(), .diverged_at_tick = std::nullopt};
  const Extremes places = history.extremes(&PlantTruth::position_m, range);
  if (has_diverged(places.minimum) || has_diverged(places.maximum)) {
    run_end.diverged_at_tick = tail.end_tick;
  }
  tail.summary = summarise(scene, stats_of(history, range), {}, std::nullopt, run_end);
  // The summary contains that the run has diverged, but not when.
  tail.summary.diverged_at_tick.reset();
  const Extremes hand = history.extremes(&PlantTruth::hand_path_m, range);
  tail.hand_moves = hand.maximum > hand.minimum;
  if (tail.summary.verdict != Verdict::kSettled) {
    const bool force_alone = tail.summary.verdict == Verdict::kBuzzing;
    tail.frequency_hz = frequency_of(
        history, range,
        force_alone ? Quantity(&Sample::force_n) : Quantity(&PlantTruth::position_m), rate_hz);
  }
  return tail;
}

void note_tails(Tails& tails, const draw::TickHistory& history, const Scene& scene,
                std::optional<double> at_s) {
  for (std::size_t axis = 0; axis < tails.size(); ++axis) {
    Tail& tail = tails.at(axis);
    const SampleHistory& samples = history.axis(axis);
    if (axis >= scene.axes.size() || samples.empty()) {
      tail = {};
      continue;
    }
    const std::size_t end = at_s ? *samples.nearest(*at_s) + 1 : samples.size();
    if (tick_at(samples, end) != tail.end_tick) {
      tail = tail_of(samples, axis_scene(scene, axis), end);
    }
  }
}

std::string rhythm_text(const Tail& tail) {
  return tail.frequency_hz ? movement_text(tail) + " · " + file::tail_texts(tail.summary).way
                           : std::string();
}

std::string figures_text(const Summary& s) {
  const file::TailTexts tail = file::tail_texts(s);
  return fmt::format("{} · {} · {} · {}", file::verdict_text(s), tail.way, tail.force,
                     tail.stiffness);
}

std::string tail_text(const Tail& tail) {
  if (tail.end_tick == 0 || !tail.summary.tail_peak_to_peak_m) return "no sample yet";
  return figures_text(tail.summary) + " · " + movement_text(tail);
}

}  // namespace hapticwall::ui
