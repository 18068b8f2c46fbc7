#include "app/ui/panel/sound_switch.h"

#include <string>

#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kMeaning =
    "The handle's acceleration as sound: a limit cycle hums, a touch clicks.\n";

}  // namespace

void draw_sound_switch(const PanelContext& context) {
  SoundChoice& sound = context.sound;
  if (choice_button(context, "Sound###sound", sound.on, kMeaning + describe(sound.status),
                    {.width = ems(kSoundEms)}))
    sound.on = !sound.on;
}

void draw_volume(const PanelContext& context) {
  constexpr double kMin = 0.0;
  constexpr double kMax = kPercent;
  double& volume = context.sound.volume;
  double percent = volume * kPercent;
  ImGui::SetNextItemWidth(ems(kVolumeEms));
  if (ImGui::SliderScalar("##volume", ImGuiDataType_Double, &percent, &kMin, &kMax, "%.0f %%",
                          ImGuiSliderFlags_AlwaysClamp))
    volume = percent / kPercent;
  explain("Volume of the sound");
}

}  // namespace hapticwall::ui
