// The switch of the live sound, and its volume.
#pragma once

#include "app/sound/live/sound_status.h"
#include "app/ui/state/panel_context.h"

namespace hapticwall::ui {

inline constexpr float kSoundEms = 4.5F;
inline constexpr float kVolumeEms = 5.0F;

struct SoundChoice {
  double volume = 0.5;  // 0 to 1; stored in the settings file
  bool on = false;
  bool available = true;  // false: this machine has no card, and the switch is not shown
  sound::SoundStatus status;
};

void draw_sound_switch(const PanelContext& context);
void draw_volume(const PanelContext& context);

}  // namespace hapticwall::ui
