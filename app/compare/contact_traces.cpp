#include "app/compare/contact_traces.h"

#include <algorithm>
#include <cmath>

#include "core/algorithm/algorithm.h"
#include "core/study/energy_story.h"

namespace hapticwall::compare {
std::string describe(const AlgorithmSettings& settings) {
  std::string keys;
  const std::span<const ParameterDescription> parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!settings.values[i] || !reads(settings, parameters[i].key)) continue;
    keys += keys.empty() ? " (" : ", ";
    keys += std::string(parameters[i].key) + " = " + value_text(parameters[i], *settings.values[i]);
  }
  return std::string(algorithms()[settings.index].name) + keys + (keys.empty() ? "" : ")");
}

ContactTraces::ContactTraces(const AlgorithmSettings& a, const AlgorithmSettings& b, double rate_hz)
    : slots_{Contents{a, {}}, Contents{b, {}}},
      most_points_(
          std::min(static_cast<std::size_t>(std::ceil(kTraceS * rate_hz)), kMaxTracePoints)),
      rest_ticks_(static_cast<std::uint64_t>(std::ceil(kRestS * rate_hz))) {
  for (Contents& slot : slots_) slot.trace.reserve(most_points_);
}

const AlgorithmSettings& ContactTraces::activate(Slot slot) {
  active_ = slot;
  // The loop does not change when both are equal.
  if (settings(active_) == settings(sampled_) || !has_previous_) sampled_ = active_;
  return settings(active_);
}

void ContactTraces::add(const Sample& sample) {
  note_changes(sample);
  const bool in_contact = (sample.flags & kFlagInContact) != 0;
  if (in_contact && resting_ticks_ >= rest_ticks_) begin_contact(sample);
  const bool rests = !in_contact && sample.force_n == 0.0;
  resting_ticks_ = rests ? resting_ticks_ + 1 : 0;
  if (tracing_) append(sample);
  previous_ = sample;
  has_previous_ = true;
}

void ContactTraces::note_changes(const Sample& sample) {
  if (has_previous_ && sample.generation != previous_.generation) {
    sampled_ = active_;
    tracing_ = false;
  }
  if (has_previous_ && sample.tick > previous_.tick) return;
  onset_tick_.reset();
  resting_ticks_ = rest_ticks_;
  tracing_ = false;
  previous_ = sample;  // no earlier sample
}

void ContactTraces::begin_contact(const Sample& sample) {
  onset_tick_ = sample.tick;
  before_onset_ = previous_;
  slots_[index(sampled_)].trace.clear();
  tracing_ = true;
}

void ContactTraces::append(const Sample& sample) {
  std::vector<TracePoint>& trace = slots_[index(sampled_)].trace;
  if (trace.size() >= most_points_) return;
  trace.push_back({static_cast<std::uint32_t>(sample.tick - *onset_tick_), sample.position_m,
                   sample.penetration_m, sample.force_n, sample.stiffness_n_per_m,
                   sample.energy_cv_j - before_onset_.energy_cv_j,
                   sample.energy_hold_j - before_onset_.energy_hold_j,
                   sample.energy_scv_j - before_onset_.energy_scv_j,
                   sample.energy_budget_j - before_onset_.energy_budget_j});
}

std::optional<Ghost> ContactTraces::ghost() const {
  const Slot shown = other(active_);
  if (!onset_tick_ || trace(shown).empty()) return std::nullopt;
  return Ghost{shown, *onset_tick_, trace(shown), ledger_of(before_onset_)};
}

}  // namespace hapticwall::compare
