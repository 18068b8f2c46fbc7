#include "app/ui/state/appearance.h"

#include <algorithm>
#include <cmath>

#include "app/session/window_options.h"

namespace hapticwall::ui {
namespace {

constexpr float kFullScalePercent = 100.0F;
constexpr int kStepPercent = 10;
float chosen_scale(const Appearance& appearance) {
  const float chosen = static_cast<float>(appearance.scale_percent) / kFullScalePercent;
  return appearance.forced_scale.value_or(chosen > 0.0F ? chosen : appearance.screen_scale);
}

float allowed(float scale) {
  return std::clamp(scale, session::kMinScalePercent / kFullScalePercent,
                    session::kMaxScalePercent / kFullScalePercent);
}

}  // namespace

float scale_in_force(const Appearance& appearance) { return allowed(chosen_scale(appearance)); }

int scale_percent_in_force(const Appearance& appearance) {
  return static_cast<int>(std::lround(scale_in_force(appearance) * kFullScalePercent));
}

void set_scale(Appearance& appearance, int percent) {
  appearance.forced_scale.reset();
  appearance.scale_percent =
      percent == 0 ? 0 : std::clamp(percent, session::kMinScalePercent, session::kMaxScalePercent);
}

void step_scale(Appearance& appearance, int steps) {
  // Rounds to whole steps: from 125 % up to 130 %, down to 120 %.
  const int now = scale_percent_in_force(appearance);
  const int whole = steps > 0 ? now / kStepPercent : (now + kStepPercent - 1) / kStepPercent;
  set_scale(appearance, (whole + steps) * kStepPercent);
}

void toggle_look(const PanelContext& context) {
  draw::Look& look = context.appearance.look;
  look = look == draw::Look::kLight ? draw::Look::kScreen : draw::Look::kLight;
}

}  // namespace hapticwall::ui
