#include "app/draw/verdict/tail.h"

#include <fmt/format.h>

#include "app/file/text/text.h"
#include "app/file/text/verdict.h"
#include "core/run/metrics.h"

namespace hapticwall::draw {
namespace {

using file::fixed;

constexpr double kCrossed = 0.25;  // share of the extremes, on either side of their middle

// The tick after the sample before `end`.
std::uint64_t tick_at(const SampleHistory& history, std::size_t end) {
  return static_cast<std::uint64_t>(history.value(&Sample::tick, end - 1)) + 1;
}

// Energy that actuator and losses have taken at each sample, as Metrics counts it.
class Absorbed {
 public:
  Absorbed(const SampleHistory& history, bool knows_truth)
      : history_(history), knows_truth_(knows_truth) {}

  // Call it for neighbouring samples, in order.
  double at(std::size_t i) {
    if (knows_truth_) {
      return history_.value(&PlantTruth::actuator_work_j, i) +
             history_.value(&PlantTruth::dissipation_j, i);
    }
    return applied_.absorbed_j(history_.value(&Sample::position_m, i),
                               history_.value(&Sample::applied_force_n, i),
                               history_.value(&Sample::energy_budget_j, i));
  }

 private:
  const SampleHistory& history_;
  bool knows_truth_;
  AppliedEnergy applied_;
};

// Statistics of the tail `range`, judged with the pieces before it that decide whether its first
// one is judged, and with the pieces of a run that begins at tick 0.
RunStats stats_of(const SampleHistory& history, IndexRange range, double rate_hz,
                  bool knows_truth) {
  const std::uint64_t piece = piece_ticks(rate_hz);
  const std::uint64_t tail_tick = tick_at(history, range.first + 1) - 1;
  const std::uint64_t before = kTouchingBefore * piece + tail_tick % piece;
  const std::uint64_t first = range.first - std::min<std::uint64_t>(range.first, before);
  std::size_t from = first;
  while (from < range.first && (tick_at(history, from + 1) - 1) % piece != 0) ++from;
  TickMetrics metrics(rate_hz, range.first, range.first);
  Absorbed absorbed(history, knows_truth);
  for (std::size_t i = from; i < range.last; ++i) {
    const auto flags = static_cast<std::uint32_t>(history.value(&Sample::flags, i));
    metrics.add(i,
                {history.value(&PlantTruth::position_m, i),
                 history.value(&PlantTruth::velocity_m_per_s, i), absorbed.at(i),
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
  return is_good(tail.summary.verdict) ? "the hand moves" : "no rhythm";
}

std::string numbers_text(const Summary& s) {
  const file::TailTexts tail = file::tail_texts(s);
  return fmt::format("{} · {} · {}", tail.way, tail.force, tail.stiffness);
}

// True for a verdict about something that swings.
bool shakes(Verdict verdict) {
  return verdict == Verdict::kBuzzing || verdict == Verdict::kOscillating;
}

}  // namespace

Tail tail_of(const SampleHistory& history, const Scene& scene, std::size_t end, bool knows_truth) {
  Tail tail;
  if (end == 0) return tail;
  const double rate_hz = scene.sampling.rate_hz;
  const IndexRange range{static_cast<std::size_t>(tail_begin_tick(end, rate_hz)), end};
  tail.end_tick = tick_at(history, end);
  const Extremes hand = history.extremes(&PlantTruth::hand_path_m, range);
  RunEnd run_end{.ticks = range.count(),
                 .diverged_at_tick = std::nullopt,
                 .hand_rests = knows_truth && !(hand.maximum > hand.minimum),
                 .has_truth = knows_truth};
  const Extremes places = history.extremes(&PlantTruth::position_m, range);
  if (has_diverged(places.minimum) || has_diverged(places.maximum)) {
    run_end.diverged_at_tick = tail.end_tick;
  }
  tail.summary =
      summarise(scene, stats_of(history, range, rate_hz, knows_truth), {}, std::nullopt, run_end);
  // The summary contains that the run has diverged, but not when.
  tail.summary.diverged_at_tick.reset();
  if (shakes(tail.summary.verdict)) {
    const bool force_alone = tail.summary.verdict == Verdict::kBuzzing;
    tail.frequency_hz = frequency_of(
        history, range,
        force_alone ? Quantity(&Sample::force_n) : Quantity(&PlantTruth::position_m), rate_hz);
  }
  return tail;
}

void note_tails(Tails& tails, const draw::TickHistory& history, const Scene& scene,
                bool knows_truth, std::optional<double> at_s) {
  for (std::size_t axis = 0; axis < tails.size(); ++axis) {
    Tail& tail = tails.at(axis);
    const SampleHistory& samples = history.axis(axis);
    if (axis >= scene.axes.size() || samples.empty()) {
      tail = {};
      continue;
    }
    const std::size_t end = at_s ? *samples.nearest(*at_s) + 1 : samples.size();
    if (tick_at(samples, end) != tail.end_tick) {
      tail = tail_of(samples, axis_scene(scene, axis), end, knows_truth);
    }
  }
}

std::string rhythm_text(const Tail& tail) {
  return tail.frequency_hz ? movement_text(tail) + " · " + file::tail_texts(tail.summary).way
                           : std::string();
}

std::string figures_text(const Summary& s) {
  return file::verdict_text(s) + " · " + numbers_text(s);
}

std::string tail_numbers_text(const Tail& tail) {
  if (tail.end_tick == 0 || !tail.summary.tail_peak_to_peak_m) return "no sample yet";
  return numbers_text(tail.summary) + " · " + movement_text(tail);
}

std::string tail_text(const Tail& tail) {
  if (tail.end_tick == 0 || !tail.summary.tail_peak_to_peak_m) return tail_numbers_text(tail);
  return file::verdict_text(tail.summary) + " · " + tail_numbers_text(tail);
}

}  // namespace hapticwall::draw
