#include "app/ui/state/comparing.h"

#include <fmt/format.h>

#include <string_view>

#include "app/draw/plot/extra_traces.h"
#include "app/file/text/number_name.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/scene_state.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

using compare::Slot;

constexpr std::string_view kUsualOther = "energy-bounding";
constexpr std::string_view kOtherThanThat = "none";

double encoder_of(const Scene& scene) { return scene.x().device.encoder_m.value_or(0.0); }

void begin_lamp(CompareState::Transient& compare, const Scene& scene) {
  compare.lamp_encoder_m = encoder_of(scene);
  compare.lamp.emplace(scene.sampling.rate_hz, compare.lamp_encoder_m);
}

}  // namespace

CompareSlots slots_for(const Scene& scene, std::optional<std::size_t> other) {
  CompareSlots slots;
  slots.settings.fill(scene.algorithm);
  std::optional<std::size_t> index = other ? other : find_algorithm(kUsualOther);
  if (index == scene.algorithm.index) index = find_algorithm(kUsualOther);
  if (index == scene.algorithm.index) index = find_algorithm(kOtherThanThat);
  slots.settings.back().index = index.value_or(scene.algorithm.index);
  return slots;
}

CompareSlots slots_of(const CompareState& compare) {
  const auto& comparison = compare.transient.comparison;
  if (!comparison) return {};
  return {comparison->active(), {comparison->settings(Slot::kA), comparison->settings(Slot::kB)}};
}

CompareSlots slots_after(const CompareState& compare, const WantedScene& wanted) {
  CompareSlots slots = slots_of(compare);
  if (wanted.loaded) return slots_for(wanted.scene, slots.of(Slot::kB).index);
  if (wanted.slots) slots.settings = *wanted.slots;
  return slots;
}

void begin_comparison(CompareState& state, PlotsState& plots, Toasts& toasts, const Scene& scene,
                      const CompareSlots& slots) {
  CompareState::Transient& compare = state.transient;
  if (blind_test_runs(state)) {
    finish(*compare.test);
    toasts.tell(MessageKind::kNote, "the blind test ended: another session has begun");
  }
  compare.comparison.emplace(slots.of(Slot::kA), slots.of(Slot::kB), scene.sampling.rate_hz);
  compare.comparison->activate(slots.active);
  compare.shown_ghost.reset();
  replace_extra_traces(plots.transient.extra_traces, draw::ExtraSource::kComparison, {});
  begin_lamp(compare, scene);
}

void set_slots(CompareState& compare, const std::array<AlgorithmSettings, 2>& settings) {
  auto& comparison = compare.transient.comparison;
  if (!comparison) return;
  comparison->set_settings(Slot::kA, settings.front());
  comparison->set_settings(Slot::kB, settings.back());
}

void note_ticks(CompareState& state, const Scene& scene, std::span<const Tick> ticks) {
  CompareState::Transient& compare = state.transient;
  if (compare.test && compare.test->running && compare.test->felt) {
    for (const Tick& tick : ticks) compare.test->exposure.add(tick, scene.sampling.period_s());
  }
  if (!compare.comparison || !compare.lamp) return;
  // The lamp's threshold is the energy of one encoder count.
  if (compare.lamp_encoder_m != encoder_of(scene)) begin_lamp(compare, scene);
  for (const Tick& tick : ticks) {
    compare.comparison->add(tick.x());
    compare.lamp->add(tick.x());
  }
}

void keep_slots(CompareState& compare, const Scene& scene) {
  auto& comparison = compare.transient.comparison;
  if (comparison) comparison->set_settings(comparison->active(), scene.algorithm);
}

void choose_slot(const PanelContext& context, Slot slot) {
  auto& comparison = context.compare.transient.comparison;
  if (context.shows.live == nullptr || !comparison) return;
  // An edit of this frame belongs to the slot in which it was made.
  keep_slots(context.compare, context.session.scene());
  if (const auto problem = ask_for_algorithm(context, comparison->settings(slot)))
    return tell(context.toasts, *problem);
  comparison->activate(slot);
}

void toggle_slot(const PanelContext& context) {
  choose_slot(context, compare::other(slots_of(context.compare).active));
}

void keep_walls_apart(const PanelContext& context, const AlgorithmSettings& before,
                      std::size_t index) {
  auto& comparison = context.compare.transient.comparison;
  if (!comparison) return;
  const Slot other = compare::other(comparison->active());
  if (comparison->settings(other).index == index) comparison->set_settings(other, before);
}

void take_present(const PanelContext& context, Slot slot) {
  auto& comparison = context.compare.transient.comparison;
  if (comparison) comparison->set_settings(slot, context.session.scene().algorithm);
}

std::string algorithm_name(const AlgorithmSettings& settings) {
  const auto list = algorithms();
  return settings.index < list.size() ? std::string(list[settings.index].name) : "unknown";
}

std::string set_keys_text(const AlgorithmSettings& settings) {
  const auto list = algorithms();
  if (settings.index >= list.size()) return {};
  std::string text;
  for (const ParameterDescription& parameter : list[settings.index].parameters) {
    const auto index = find_algorithm_parameter(parameter.key);
    if (!index || !settings.values.at(*index)) continue;
    text += fmt::format("{}{} {}{}{}", text.empty() ? "" : ", ", file::key_in_words(parameter.key),
                        value_text(parameter, *settings.values.at(*index)),
                        parameter.unit.empty() ? "" : " ", parameter.unit);
  }
  return text;
}

}  // namespace hapticwall::ui
