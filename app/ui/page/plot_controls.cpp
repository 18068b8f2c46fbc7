#include "app/ui/page/plot_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/page/plot_export.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"
#include "core/study/stability_bounds.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kArrangementEms = 8.5F;
constexpr float kFollowEms = 4.4F;
constexpr float kWindowEms = 5.5F;
constexpr float kTriggerEms = 9.5F;
constexpr float kExportEms = 3.6F;
constexpr double kMaxPrePercent = 90.0;

constexpr std::array kAllPlots{draw::PlotId::kPosition, draw::PlotId::kForce,
                               draw::PlotId::kStiffness, draw::PlotId::kPassivity};
constexpr std::array kFigure4Plots{draw::PlotId::kPosition, draw::PlotId::kForce,
                                   draw::PlotId::kPassivity};
constexpr std::array kFigure5And6Plots{draw::PlotId::kPosition, draw::PlotId::kForce,
                                       draw::PlotId::kStiffness};

struct Arrangement {
  PlotArrangement value;
  const char* name;
  const char* meaning;
};
constexpr std::array kArrangements{
    Arrangement{PlotArrangement::kAll, "all plots", "Position, force, stiffness and passivity"},
    Arrangement{PlotArrangement::kFigure4, "as Figure 4",
                "The panels of the paper's Figure 4: position, force, passivity"},
    Arrangement{PlotArrangement::kFigure5And6, "as Figures 5, 6",
                "The panels of the paper's Figures 5 and 6: position, force, stiffness"}};

// In the order of TriggerMode.
struct Mode {
  const char* name;
  const char* meaning;
};
constexpr std::array kModes{
    Mode{"off", "The plots follow the newest samples"},
    Mode{"auto", "At the newest contact, or at the newest samples when there is none for a while"},
    Mode{"normal", "At the newest contact, until the next one"},
    Mode{"single", "At the next contact, then frozen; Arm waits for the next one"}};

float ems(float count) { return count * ImGui::GetFontSize(); }

void draw_arrangement(const PanelContext& context) {
  PlotArrangement& arrangement = context.state.persisted.arrangement;
  const auto current = std::find_if(kArrangements.begin(), kArrangements.end(),
                                    [&](const Arrangement& a) { return a.value == arrangement; });
  ImGui::SetNextItemWidth(ems(kArrangementEms));
  if (ImGui::BeginCombo("##arrangement", current->name)) {
    for (const Arrangement& choice : kArrangements) {
      if (ImGui::Selectable(choice.name, choice.value == arrangement)) arrangement = choice.value;
      explain(choice.meaning);
    }
    ImGui::EndCombo();
  } else {
    explain("Which plots are shown");
  }
  ImGui::SameLine();
  bool& phase = context.state.plots.persisted.phase.shown;
  if (choice_button(context, "Loop###phase plane", phase)) phase = !phase;
  explain("Force over penetration; the area of the loop is energy");
  ImGui::SameLine();
}

void toggle_follow(UiState& state) { state.transient.follow = !state.transient.follow; }

void draw_follow(const PanelContext& context) {
  const bool following = context.state.transient.follow;
  const bool single = context.state.plots.persisted.trigger.mode == draw::TriggerMode::kSingle;
  const char* label = following ? "Freeze###follow" : single ? "Arm###follow" : "Follow###follow";
  if (ImGui::Button(label, ImVec2(ems(kFollowEms), 0.0F))) toggle_follow(context.state);
  explain(following ? "The plots follow the session: stops them (key F). A drag or the wheel in a "
                      "plot does it, too."
                    : "Back to the newest samples, or to the next contact (key F)");
  ImGui::SameLine();
}

std::string length_text(double length_s) {
  constexpr double kMinuteS = 60.0;
  constexpr double kHourS = 3600.0;
  if (length_s >= kHourS) return fmt::format("{:g} h", length_s / kHourS);
  if (length_s >= kMinuteS) return fmt::format("{:g} min", length_s / kMinuteS);
  if (length_s < 0.5) return fmt::format("{:g} ms", length_s * 1e3);
  return fmt::format("{:g} s", length_s);
}

void draw_length(const PanelContext& context) {
  double& length_s = context.state.persisted.time_window_s;
  ImGui::SetNextItemWidth(ems(kWindowEms));
  if (ImGui::BeginCombo("##time window", length_text(length_s).c_str(),
                        ImGuiComboFlags_HeightLarge)) {
    for (const double choice_s : kTimeWindowsS) {
      const std::string text = length_text(choice_s);
      if (ImGui::Selectable(fmt::format("{0}###length {0}", text).c_str(), choice_s == length_s)) {
        length_s = choice_s;
        context.state.transient.follow = true;
      }
    }
    ImGui::EndCombo();
  } else {
    explain("The length of the time axes");
  }
  ImGui::SameLine();
}

void make_automatic(PlotsState& plots) {
  for (draw::PlotAxes& axes : plots.transient.axes) {
    axes.left.manual = false;
    axes.right.manual = false;
  }
  plots.transient.phase.penetration.manual = false;
  plots.transient.phase.force.manual = false;
}

bool any_manual(const PlotsState& plots) {
  const auto& phase = plots.transient.phase;
  return phase.penetration.manual || phase.force.manual ||
         std::any_of(
             plots.transient.axes.begin(), plots.transient.axes.end(),
             [](const draw::PlotAxes& axes) { return axes.left.manual || axes.right.manual; });
}

void draw_automatic(const PanelContext& context) {
  ImGui::BeginDisabled(!any_manual(context.state.plots));
  if (ImGui::Button("Auto###automatic axes")) make_automatic(context.state.plots);
  ImGui::EndDisabled();
  explain(
      "Fits all value axes again. The wheel or a drag over an axis, or a right drag in a plot, "
      "fixes them; a double click makes one plot automatic.");
  ImGui::SameLine();
}

void set_mode(UiState& state, draw::TriggerMode mode) {
  state.plots.persisted.trigger.mode = mode;
  state.plots.transient.trigger = {};
  state.plots.transient.was_following = false;  // arms it
  state.transient.follow = true;
}

const char* stage_text(draw::TriggerStage stage) {
  switch (stage) {
    case draw::TriggerStage::kFilling:
      return "filling";
    case draw::TriggerStage::kShown:
      return "contact";
    case draw::TriggerStage::kDone:
      return "done";
    case draw::TriggerStage::kWaiting:
      break;
  }
  return "waiting";
}

void draw_trigger_choices(const PanelContext& context) {
  draw::TriggerSettings& settings = context.state.plots.persisted.trigger;
  ImGui::TextDisabled("The time axes stand at a contact");
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    const auto mode = static_cast<draw::TriggerMode>(i);
    if (ImGui::RadioButton(fmt::format("{0}###trigger {0}", kModes[i].name).c_str(),
                           settings.mode == mode))
      set_mode(context.state, mode);
    explain(kModes[i].meaning);
    ImGui::SameLine();
  }
  ImGui::NewLine();
  const double least = 0.0;
  double percent = settings.pre_share * kPercent;
  ImGui::SetNextItemWidth(ems(10.0F));
  if (ImGui::SliderScalar("before it###pre-trigger", ImGuiDataType_Double, &percent, &least,
                          &kMaxPrePercent, "%.0f %%", ImGuiSliderFlags_AlwaysClamp)) {
    settings.pre_share = percent / kPercent;
  }
  explain("How much of the time axes lies before the contact");
}

void draw_trigger(const PanelContext& context) {
  const draw::TriggerSettings& settings = context.state.plots.persisted.trigger;
  const bool on = settings.mode != draw::TriggerMode::kOff;
  const std::string label =
      on ? fmt::format("{}: {}###trigger", kModes[static_cast<std::size_t>(settings.mode)].name,
                       stage_text(context.state.plots.transient.trigger.stage))
         : "Trigger###trigger";
  const ImU32 background =
      on ? context.theme.packed(draw::Tone::kAccent, 0.30F) : IM_COL32_BLACK_TRANS;
  ImGui::PushStyleColor(ImGuiCol_Button, background);
  if (ImGui::Button(label.c_str(), ImVec2(ems(kTriggerEms), 0.0F))) ImGui::OpenPopup("trigger");
  ImGui::PopStyleColor();
  explain("Holds the time axes at the newest contact, like a scope (key T)");
  if (ImGui::BeginPopup("trigger")) {
    draw_trigger_choices(context);
    ImGui::EndPopup();
  }
  ImGui::SameLine();
}

void toggle_cursors(UiState& state) {
  draw::Cursors& cursors = state.plots.transient.cursors;
  cursors.shown = !cursors.shown;
  if (cursors.shown)
    place_cursors(cursors, {state.transient.time_from_s, state.transient.time_to_s});
}

void draw_cursors_button(const PanelContext& context) {
  if (choice_button(context, "Cursors###cursors", context.state.plots.transient.cursors.shown))
    toggle_cursors(context.state);
  explain("Two cursors to drag, and the signals at them (key C)");
  ImGui::SameLine();
}

void draw_exports(const PanelContext& context, const draw::SampleHistory& history) {
  const float width = 2.0F * ems(kExportEms) + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetContentRegionMax().x - width));
  const bool busy = context.state.plots.transient.exporting.running();
  const ImVec2 size(ems(kExportEms), 0.0F);
  ImGui::BeginDisabled(busy || history.empty());
  if (ImGui::Button(busy ? "…###export csv" : "CSV###export csv", size))
    export_samples(context, history);
  ImGui::EndDisabled();
  explain("Writes the samples of the visible range like a recording: CSV and sidecar");
  ImGui::SameLine();
  ImGui::BeginDisabled(history.empty());
  if (ImGui::Button("PNG###export png", size)) export_figure(context, history);
  ImGui::EndDisabled();
  explain("Draws the plots of the visible range for print into a PNG file");
}

}  // namespace

std::span<const draw::PlotId> plots_of(PlotArrangement arrangement) {
  switch (arrangement) {
    case PlotArrangement::kFigure4:
      return kFigure4Plots;
    case PlotArrangement::kFigure5And6:
      return kFigure5And6Plots;
    case PlotArrangement::kAll:
      break;
  }
  return kAllPlots;
}

void draw_plot_controls(const PanelContext& context, const draw::SampleHistory& history) {
  draw_axis_choice(context, "plots");
  draw_arrangement(context);
  draw_follow(context);
  draw_length(context);
  draw_automatic(context);
  draw_trigger(context);
  draw_cursors_button(context);
  draw_exports(context, history);
}

std::vector<KeyBinding> plot_keys() {
  const auto next_mode = [](const PanelContext& context) {
    const auto mode = static_cast<std::size_t>(context.state.plots.persisted.trigger.mode);
    set_mode(context.state, static_cast<draw::TriggerMode>((mode + 1) % kModes.size()));
  };
  return {
      {KeyGroup::kPlots,
       "follow the newest samples, or freeze",
       {ImGuiKey_F},
       [](const PanelContext& context) { toggle_follow(context.state); }},
      {KeyGroup::kPlots, "the next kind of trigger", {ImGuiKey_T}, next_mode},
      {KeyGroup::kPlots, "show or hide the cursors", {ImGuiKey_C}, [](const PanelContext& context) {
         toggle_cursors(context.state);
       }}};
}

}  // namespace hapticwall::ui
