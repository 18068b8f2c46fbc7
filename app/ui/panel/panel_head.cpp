#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/session/window_options.h"
#include "app/ui/panel/layout_choice.h"
#include "app/ui/panel/sections.h"
#include "app/ui/state/appearance.h"
#include "app/ui/state/changes.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/recording_wishes.h"
#include "app/ui/state/scene_state.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kSettings = "settings";
constexpr float kSettingsWidthEms = 22.0F;
constexpr float kPercentEms = 4.5F;
constexpr const char* kScaleField = "##scale percent";

struct Button {
  const char* label;
  const char* name;
  bool enabled;
  std::string tooltip;
  void (*act)(const PanelContext&);
};

void open_settings(const PanelContext& /*context*/) { ImGui::OpenPopup(kSettings); }

void draw_look(const PanelContext& context) {
  draw::Look& look = context.appearance.look;
  field_label(context, "colours", "Dark, or light for bright rooms (key F2)", "");
  if (ImGui::RadioButton("dark", look == draw::Look::kScreen)) look = draw::Look::kScreen;
  ImGui::SameLine();
  if (ImGui::RadioButton("light", look == draw::Look::kLight)) look = draw::Look::kLight;
}

void set_typed_scale(const PanelContext& context, double percent) {
  if (percent >= session::kMinScalePercent && percent <= session::kMaxScalePercent)
    return set_scale(context.appearance, static_cast<int>(std::lround(percent)));
  refuse(context, kScaleField,
         fmt::format("{} is out of range; it takes {} to {} %", rounded_number(percent),
                     session::kMinScalePercent, session::kMaxScalePercent));
}

void draw_scale(const PanelContext& context) {
  Appearance& appearance = context.appearance;
  field_label(
      context, "size",
      fmt::format("Size of everything, {} to {} %{}", session::kMinScalePercent,
                  session::kMaxScalePercent,
                  context.can.all_keys ? ". Keys Ctrl +, Ctrl −; Ctrl 0 follows the screen." : ""),
      "");
  if (ImGui::Button("−###smaller")) step_scale(appearance, -1);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ems(kPercentEms));
  if (const auto percent = number_field(context, kScaleField, scale_percent_in_force(appearance)))
    set_typed_scale(context, *percent);
  ImGui::SameLine();
  ImGui::TextDisabled("%%");
  ImGui::SameLine();
  if (ImGui::Button("+###larger")) step_scale(appearance, 1);
  draw_refusal(context, kScaleField);
  const bool automatic = appearance.scale_percent == 0 && !appearance.forced_scale;
  field_label(context, "", "", "");
  if (button(fmt::format("as the screen says ({:.0f} %)###automatic scale",
                         appearance.screen_scale * kPercent),
             "", {.enabled = !automatic}))
    set_scale(appearance, 0);
}

void set_recording_folder(const PanelContext& context, const std::string& folder) {
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    context.toasts.tell(MessageKind::kProblem,
                        folder + ": there is no such folder; recordings go where they went before");
    return;
  }
  context.recording.chosen_folder = context.recording.folder = folder;
}

void draw_folder(const PanelContext& context) {
  field_label(context, "recordings",
              "Folder of recordings, samples and figures. Empty: the folder in which the program "
              "was started.",
              "");
  const auto folder =
      text_field(context, "##recording folder", "the current folder", context.recording.folder);
  if (folder) set_recording_folder(context, *folder);
}

void draw_signals(const PanelContext& context) {
  field_label(context, "", "", "");
  bool& records = context.recording.records_signals;
  if (ImGui::Checkbox("signals of algorithms###record signals", &records))
    context.recording.chosen_signals = records;
  explain(
      "Recordings have the algorithms' own signals, such as energy and bound, as columns "
      "signal.NAME. From the next recording on; as --signals.");
}

void reset_layout(const PanelContext& context) {
  choose_layout(context.dock, context.window, context.plots, kUsualLayout);
  context.window.more = WindowState().more;
  context.plots.persisted.arrangement = PlotsState::Persisted().arrangement;
}

void draw_settings(const PanelContext& context, ImVec2 below) {
  ImGui::SetNextWindowPos(below, ImGuiCond_Appearing);
  ImGui::SetNextWindowSize(ImVec2(ems(kSettingsWidthEms), 0.0F));
  if (!ImGui::BeginPopup(kSettings)) return;
  draw_look(context);
  draw_scale(context);
  if (context.can.files) {
    draw_folder(context);
    draw_signals(context);
  }
  field_label(context, "layout", "", "");
  draw_layout_choice(context);
  field_label(context, "", "", "");
  if (button("as at first###reset layout",
             "Restores what is shown at first, and the layout 'bench'. Layouts of your own stay."))
    reset_layout(context);
  const std::string& path = context.window.settings_path;
  muted_text(context, path.empty() ? "Nothing of this is kept." : "Kept in " + path);
  ImGui::EndPopup();
}

}  // namespace

void draw_panel_head(const PanelContext& context) {
  const UndoHistory& undo = context.scene.undo;
  const bool changeable = context.shows.live != nullptr && !context.shows.hides_algorithm;
  const std::array buttons{
      Button{"Undo", "undo", undo.can_undo() && changeable,
             "Takes back (Ctrl+Z):\n" + undo.undo_text(), undo_change},
      Button{"Redo", "redo", undo.can_redo() && changeable,
             "Does again (Ctrl+Y):\n" + undo.redo_text(), redo_change},
      Button{"Settings", "settings", true,
             context.can.files ? "Colours, size, recordings" : "Colours, size, layout",
             open_settings},
      Button{"?", "help", true, "All keys (F1)", toggle_help}};
  draw::strong_text(context.theme, "Haptic Wall", draw::kTitleFontSize);
  ImGui::PushFont(nullptr, draw::kSmallFontSize);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float gap = style.ItemInnerSpacing.x;
  const float gap_below = style.ItemInnerSpacing.y;
  ImVec2 settings_below;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(gap, 0.5F * style.FramePadding.y));
  float width = -gap;
  for (const Button& each : buttons) width += ImGui::CalcTextSize(each.label).x + 3.0F * gap;
  beside(width);
  draw::align_right(width);
  for (const Button& each : buttons) {
    if (button(fmt::format("{}###{}", each.label, each.name), each.enabled ? each.tooltip : "",
               {.enabled = each.enabled}))
      each.act(context);
    if (each.act == open_settings)
      settings_below = ImVec2(ImGui::GetItemRectMin().x, ImGui::GetItemRectMax().y + gap_below);
    ImGui::SameLine(0.0F, gap);
  }
  ImGui::NewLine();
  ImGui::PopStyleVar();
  ImGui::PopFont();
  draw_settings(context, settings_below);
}

void show_more(WindowState& window, PlotsState& plots) {
  window.more = true;
  plots.persisted.arrangement = PlotArrangement::kAll;
}

void show_less(WindowState& window) { window.more = false; }

void toggle_help(const PanelContext& context) {
  bool& shown = context.window.help_shown;
  shown = !shown;
}

}  // namespace hapticwall::ui
