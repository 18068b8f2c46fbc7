#include "app/ui/panel_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/ui/appearance.h"
#include "app/ui/blind_test.h"
#include "app/ui/help_overlay.h"
#include "app/ui/replay_state.h"
#include "app/ui/undo_controls.h"
#include "app/ui/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kSettings = "settings";
constexpr float kSettingsWidthEms = 22.0F;
constexpr float kPercentEms = 4.5F;

struct Button {
  const char* label;
  const char* name;
  bool enabled;
  std::string tooltip;
  void (*act)(const PanelContext&);
};

void open_settings(const PanelContext& /*context*/) { ImGui::OpenPopup(kSettings); }

void draw_look(const PanelContext& context) {
  Look& look = context.state.persisted.look;
  field_label(context, "colours", "Dark, or light for bright rooms (key F2)", "");
  if (ImGui::RadioButton("dark", look == Look::kScreen)) look = Look::kScreen;
  remember_item(context.state, "dark");
  ImGui::SameLine();
  if (ImGui::RadioButton("light", look == Look::kLight)) look = Look::kLight;
  remember_item(context.state, "light");
}

void draw_scale(const PanelContext& context) {
  UiState& state = context.state;
  const float em = ImGui::GetFontSize();
  field_label(context, "size",
              fmt::format("How large everything is drawn, {} to {} %. Keys Ctrl +, Ctrl −; Ctrl 0: "
                          "as the screen says.",
                          kSmallestScalePercent, kLargestScalePercent),
              "");
  if (ImGui::Button("−###smaller")) step_scale(state, -1);
  remember_item(state, "smaller");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(kPercentEms * em);
  if (const auto percent = number_field(context, "##percent", scale_percent_in_force(state)))
    set_scale(state, static_cast<int>(std::clamp(*percent, 1.0, 1e4)));
  remember_item(state, "scale percent");
  ImGui::SameLine();
  ImGui::TextDisabled("%%");
  ImGui::SameLine();
  if (ImGui::Button("+###larger")) step_scale(state, 1);
  remember_item(state, "larger");
  const bool automatic = state.persisted.scale_percent == 0 && !state.transient.forced_scale;
  field_label(context, "", "", "");
  ImGui::BeginDisabled(automatic);
  if (ImGui::Button(fmt::format("as the screen says ({:.0f} %)###automatic",
                                state.transient.screen_scale * kPercent)
                        .c_str()))
    set_scale(state, 0);
  ImGui::EndDisabled();
  remember_item(state, "automatic scale");
}

void set_recording_folder(UiState& state, const std::string& folder) {
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    tell(state, MessageKind::kProblem,
         folder +
             ": there is no such folder; recordings go where "
             "they went before");
    return;
  }
  state.persisted.recording_folder = folder;
  state.transient.recording_folder = folder;
}

void draw_folder(const PanelContext& context) {
  field_label(context, "recordings",
              "Where recordings, samples and figures are written. Empty: the folder in which the "
              "program was started.",
              "");
  const auto folder = text_field(context, "##folder", "the current folder",
                                 context.state.transient.recording_folder);
  remember_item(context.state, "recording folder");
  if (folder) set_recording_folder(context.state, *folder);
}

void reset_layout(PersistedState& kept) {
  const PersistedState usual;
  kept.panel_ems = usual.panel_ems;
  kept.view_share = usual.view_share;
  kept.picture_share = usual.picture_share;
}

void draw_settings(const PanelContext& context, const ItemRect& button) {
  const ImVec2 below(button.from.x, button.to.y + ImGui::GetStyle().ItemInnerSpacing.y);
  ImGui::SetNextWindowPos(below, ImGuiCond_Appearing);
  ImGui::SetNextWindowSize(ImVec2(kSettingsWidthEms * ImGui::GetFontSize(), 0.0F));
  if (!ImGui::BeginPopup(kSettings)) return;
  draw_look(context);
  draw_scale(context);
  draw_folder(context);
  field_label(context, "layout", "", "");
  if (ImGui::Button("as at first###reset")) reset_layout(context.state.persisted);
  remember_item(context.state, "reset layout");
  explain("Panel, views and plots as large as at first. Drag the gaps between them to change it.");
  const std::string& path = context.state.transient.settings_path;
  muted_text(context, path.empty() ? "Nothing of this is kept." : "Kept in " + path);
  ImGui::EndPopup();
}

}  // namespace

void draw_panel_head(const PanelContext& context) {
  const UndoHistory& undo = context.state.transient.undo;
  const bool changeable = replay_of(context.session) == nullptr && !blind_test_runs(context.state);
  const std::array buttons{
      Button{"Undo", "undo", undo.can_undo() && changeable,
             "Takes back (Ctrl+Z):\n" + undo.undo_text(), undo_change},
      Button{"Redo", "redo", undo.can_redo() && changeable,
             "Does again (Ctrl+Y):\n" + undo.redo_text(), redo_change},
      Button{"Settings", "settings", true, "Colours, size, folder of recordings", open_settings},
      Button{"?", "help", true, "All keys (F1)", toggle_help}};
  ImGui::PushFont(context.theme.fonts.strong, kTitleFontSize);
  ImGui::TextUnformatted("Haptic Wall");
  ImGui::PopFont();
  ImGui::PushFont(nullptr, kSmallFontSize);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float gap = style.ItemInnerSpacing.x;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(gap, 0.5F * style.FramePadding.y));
  float width = -gap;
  for (const Button& button : buttons) width += ImGui::CalcTextSize(button.label).x + 3.0F * gap;
  ImGui::SameLine();
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(),
                                ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width));
  for (const Button& button : buttons) {
    ImGui::BeginDisabled(!button.enabled);
    if (ImGui::Button(button.label)) button.act(context);
    ImGui::EndDisabled();
    remember_item(context.state, button.name);
    if (button.enabled) explain(button.tooltip);
    ImGui::SameLine(0.0F, gap);
  }
  ImGui::NewLine();
  ImGui::PopStyleVar();
  ImGui::PopFont();
  draw_settings(context, context.state.transient.items.at("settings"));
}

}  // namespace hapticwall::ui
