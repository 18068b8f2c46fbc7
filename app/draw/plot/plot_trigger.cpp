#include "app/draw/plot/plot_trigger.h"

#include <algorithm>

namespace hapticwall::draw {
namespace {

// The beginning of the newest contact in (after_s, up_to_s].
std::optional<double> newest_contact_s(const SampleHistory& history,
                                       const std::optional<double>& after_s, double up_to_s) {
  IndexRange range = history.range_within(history.oldest_time_s(), up_to_s);
  if (after_s) {
    // Includes the sample before: a contact begins after a sample without one.
    const std::size_t first = history.range_within(*after_s, up_to_s).first;
    range.first = std::min(first > 0 ? first - 1 : 0, range.last);
  }
  const auto contact = newest_contact(history, range);
  if (!contact) return std::nullopt;
  const double contact_s = history.value(&Sample::time_s, contact->first);
  if (after_s && contact_s <= *after_s) return std::nullopt;
  return contact_s;
}

bool impatient(const TriggerSettings& settings, const Trigger& trigger, double newest_s,
               double behind_s) {
  if (settings.mode != TriggerMode::kAuto) return false;
  return !trigger.contact_s || newest_s > *trigger.contact_s + behind_s + kAutoPatienceS;
}

}  // namespace

Trigger armed_trigger(const TriggerSettings& settings, double newest_s) {
  Trigger trigger;
  if (settings.mode == TriggerMode::kSingle) trigger.after_s = newest_s;
  return trigger;
}

std::optional<TimeWindow> run_trigger(const SampleHistory& history, const TriggerSettings& settings,
                                      double length_s, Trigger& trigger) {
  const double newest_s = history.newest_time_s();
  // A reset restarts the time and clears the history.
  if (trigger.contact_s && *trigger.contact_s > newest_s) trigger = {};
  if (trigger.after_s && *trigger.after_s > newest_s) trigger.after_s.reset();
  const double behind_s = (1.0 - settings.pre_share) * length_s;
  const bool full = trigger.contact_s && newest_s >= *trigger.contact_s + behind_s;
  const bool once = settings.mode == TriggerMode::kSingle && trigger.contact_s.has_value();
  if (!once && (full || !trigger.contact_s)) {
    const double up_to_s = behind_s > kMaxUnseenFillS ? newest_s : newest_s - behind_s;
    if (const auto found_s = newest_contact_s(history, trigger.after_s, up_to_s)) {
      trigger.contact_s = found_s;
      trigger.after_s = found_s;
    }
  }
  if (!trigger.contact_s || impatient(settings, trigger, newest_s, behind_s)) {
    trigger.stage = TriggerStage::kWaiting;
    if (settings.mode == TriggerMode::kAuto) return newest_window(newest_s, length_s);
    return std::nullopt;
  }
  const double to_s = *trigger.contact_s + behind_s;
  trigger.stage = TriggerStage::kFilling;
  if (newest_s >= to_s) {
    const bool single = settings.mode == TriggerMode::kSingle;
    trigger.stage = single ? TriggerStage::kDone : TriggerStage::kShown;
  }
  return TimeWindow{to_s - length_s, to_s};
}

TimeWindow newest_window(double newest_s, double length_s) {
  const double to_s = std::max(newest_s, length_s);
  return {to_s - length_s, to_s};
}

std::optional<IndexRange> newest_contact(const SampleHistory& history, IndexRange range) {
  std::size_t end = range.last;
  const auto last = history.newest_above(&Sample::penetration_m, {range.first, end}, 0.0);
  if (!last) return std::nullopt;
  end = *last + 1;
  const auto before = history.newest_not_above(&Sample::penetration_m, {range.first, *last}, 0.0);
  if (!before) return std::nullopt;
  return IndexRange{*before + 1, end};
}

}  // namespace hapticwall::draw
