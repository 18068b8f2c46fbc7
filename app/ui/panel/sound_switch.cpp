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
  TransientState& transient = context.state.transient;
  if (choice_button(context, "Sound###sound", transient.sound_on,
                    kMeaning + describe(transient.sound), {.width = ems(kSoundEms)}))
    transient.sound_on = !transient.sound_on;
}

void draw_volume(const PanelContext& context) {
  constexpr double kMin = 0.0;
  constexpr double kMax = kPercent;
  double& volume = context.state.persisted.sound_volume;
  double percent = volume * kPercent;
  ImGui::SetNextItemWidth(ems(kVolumeEms));
  if (ImGui::SliderScalar("##volume", ImGuiDataType_Double, &percent, &kMin, &kMax, "%.0f %%",
                          ImGuiSliderFlags_AlwaysClamp))
    volume = percent / kPercent;
  explain("Volume of the sound");
}

}  // namespace hapticwall::ui
