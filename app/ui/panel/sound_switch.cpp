#include "app/ui/panel/sound_switch.h"

#include <string>

#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kSwitchEms = 4.5F;
constexpr float kVolumeEms = 5.0F;
constexpr float kGapEms = 1.0F;
constexpr const char* kMeaning =
    "The handle's acceleration as sound: a limit cycle hums, a touch clicks.\n";

void draw_volume(double& volume) {
  constexpr double kMin = 0.0;
  constexpr double kMax = kPercent;
  double percent = volume * kPercent;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ems(kVolumeEms));
  if (ImGui::SliderScalar("##volume", ImGuiDataType_Double, &percent, &kMin, &kMax, "%.0f %%",
                          ImGuiSliderFlags_AlwaysClamp))
    volume = percent / kPercent;
  explain("Volume of the sound");
}

}  // namespace

void draw_sound_switch(const PanelContext& context) {
  TransientState& transient = context.state.transient;
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < ems(kSwitchEms + kVolumeEms + kGapEms)) ImGui::NewLine();
  if (choice_button(context, "Sound###sound", transient.sound_on,
                    kMeaning + describe(transient.sound), {.width = ems(kSwitchEms)}))
    transient.sound_on = !transient.sound_on;
  if (!transient.sound.card.empty()) draw_volume(context.state.persisted.sound_volume);
}

}  // namespace hapticwall::ui
