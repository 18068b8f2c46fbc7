// The switch of the live sound, and its volume.
#pragma once

#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

inline constexpr float kSoundEms = 4.5F;
inline constexpr float kVolumeEms = 5.0F;

void draw_sound_switch(const PanelContext& context);
void draw_volume(const PanelContext& context);

}  // namespace hapticwall::ui
