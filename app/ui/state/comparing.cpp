#include "app/ui/state/comparing.h"

#include <fmt/format.h>

#include <string_view>

#include "app/draw/plot/extra_traces.h"
#include "app/ui/state/blind_test.h"
#include "app/ui/state/changes.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

using compare::Slot;

constexpr std::string_view kUsualOther = "energy-bounding";
constexpr std::string_view kOtherThanThat = "virtual-coupling";

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

CompareSlots slots_of(const UiState& state) {
  const auto& comparison = state.compare.transient.comparison;
  if (!comparison) return {};
  return {comparison->active(), {comparison->settings(Slot::kA), comparison->settings(Slot::kB)}};
}

CompareSlots slots_after(const UiState& state, const WantedScene& wanted) {
  CompareSlots slots = slots_of(state);
  if (wanted.loaded) return slots_for(wanted.scene, slots.of(Slot::kB).index);
  if (wanted.slots) slots.settings = *wanted.slots;
  return slots;
}

void begin_comparison(UiState& state, const Scene& scene, const CompareSlots& slots) {
  CompareState::Transient& compare = state.compare.transient;
  if (blind_test_runs(state)) {
    finish(*compare.test);
    tell(state, MessageKind::kNote, "the blind test ended: another session has begun");
  }
  compare.comparison.emplace(slots.of(Slot::kA), slots.of(Slot::kB), scene.sampling.rate_hz);
  compare.comparison->activate(slots.active);
  compare.shown_ghost.reset();
  replace_extra_traces(state.plots.transient.extra_traces, draw::ExtraSource::kComparison, {});
  begin_lamp(compare, scene);
}

void set_slots(UiState& state, const std::array<AlgorithmSettings, 2>& settings) {
  auto& comparison = state.compare.transient.comparison;
  if (!comparison) return;
  comparison->set_settings(Slot::kA, settings.front());
  comparison->set_settings(Slot::kB, settings.back());
}

void note_ticks(UiState& state, const Scene& scene, std::span<const Tick> ticks) {
  CompareState::Transient& compare = state.compare.transient;
  if (!compare.comparison || !compare.lamp) return;
  // The lamp's threshold is the energy of one encoder count.
  if (compare.lamp_encoder_m != encoder_of(scene)) begin_lamp(compare, scene);
  for (const Tick& tick : ticks) {
    compare.comparison->add(tick.x());
    compare.lamp->add(tick.x());
  }
}

void keep_slots(UiState& state, const Scene& scene) {
  auto& comparison = state.compare.transient.comparison;
  if (comparison) comparison->set_settings(comparison->active(), scene.algorithm);
}

void choose_slot(const PanelContext& context, Slot slot) {
  auto& comparison = context.state.compare.transient.comparison;
  if (context.shows.live == nullptr || !comparison) return;
  // An edit of this frame belongs to the slot in which it was made.
  keep_slots(context.state, context.session.scene());
  if (const auto problem = ask_for_algorithm(context, comparison->settings(slot)))
    return tell(context.state, *problem);
  comparison->activate(slot);
}

void toggle_slot(const PanelContext& context) {
  choose_slot(context, compare::other(slots_of(context.state).active));
}

void take_present(const PanelContext& context, Slot slot) {
  auto& comparison = context.state.compare.transient.comparison;
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
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", parameter.key,
                        value_text(parameter, *settings.values.at(*index)));
  }
  return text;
}

}  // namespace hapticwall::ui
