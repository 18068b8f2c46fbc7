#include "app/ui/state/appearance.h"

#include <algorithm>
#include <cmath>

namespace hapticwall::ui {
namespace {

constexpr float kFullScalePercent = 100.0F;
constexpr int kStepPercent = 10;

}  // namespace

float scale_in_force(const UiState& state) {
  const TransientState& transient = state.transient;
  const float chosen = static_cast<float>(state.persisted.scale_percent) / kFullScalePercent;
  const float scale =
      transient.forced_scale.value_or(chosen > 0.0F ? chosen : transient.screen_scale);
  return std::clamp(scale, runtime::kMinScalePercent / kFullScalePercent,
                    runtime::kMaxScalePercent / kFullScalePercent);
}

int scale_percent_in_force(const UiState& state) {
  return static_cast<int>(std::lround(scale_in_force(state) * kFullScalePercent));
}

void set_scale(UiState& state, int percent) {
  state.transient.forced_scale.reset();
  state.persisted.scale_percent =
      percent == 0 ? 0 : std::clamp(percent, runtime::kMinScalePercent, runtime::kMaxScalePercent);
}

void step_scale(UiState& state, int steps) {
  // Rounds to whole steps: from 125 % up to 130 %, down to 120 %.
  const int now = scale_percent_in_force(state);
  const int whole = steps > 0 ? now / kStepPercent : (now + kStepPercent - 1) / kStepPercent;
  set_scale(state, (whole + steps) * kStepPercent);
}

void toggle_look(const PanelContext& context) {
  draw::Look& look = context.state.persisted.look;
  look = look == draw::Look::kLight ? draw::Look::kScreen : draw::Look::kLight;
}

}  // namespace hapticwall::ui
