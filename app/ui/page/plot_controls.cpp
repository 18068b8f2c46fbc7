#include "app/ui/page/plot_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "app/ui/state/plots_state.h"
#include "app/ui/state/time_view.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/shown_axis.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kArrangementEms = 8.5F;
constexpr float kFollowEms = 4.4F;
constexpr float kWindowEms = 7.5F;
constexpr float kTriggerEms = 9.5F;
constexpr float kTextButtonEms = 3.6F;
constexpr float kExportEms = 3.6F;
constexpr double kMaxPrePercent = 90.0;

constexpr std::array kTwoPlots{draw::PlotId::kPosition, draw::PlotId::kForce};
constexpr std::array kFigure4Plots{draw::PlotId::kPosition, draw::PlotId::kForce,
                                   draw::PlotId::kPassivity};
constexpr std::array kFigure5And6Plots{draw::PlotId::kPosition, draw::PlotId::kForce,
                                       draw::PlotId::kStiffness};

// Words for an arrangement; the list is in the order of PlotArrangement.
struct Arrangement {
  const char* name;
  const char* meaning;
  std::span<const draw::PlotId> plots;
};
constexpr std::array kArrangements{
    Arrangement{"two plots", "Position and force", kTwoPlots},
    Arrangement{"all plots", "Position, force, stiffness and passivity", draw::kAllPlots},
    Arrangement{"as Figure 4", "The panels of the paper's Figure 4: position, force, passivity",
                kFigure4Plots},
    Arrangement{"as Figures 5, 6",
                "The panels of the paper's Figures 5 and 6: position, force, stiffness",
                kFigure5And6Plots}};

const Arrangement& arrangement_of(PlotArrangement arrangement) {
  return kArrangements.at(static_cast<std::size_t>(arrangement));
}

// Words for a trigger mode; the list is in the order of TriggerMode.
struct Mode {
  const char* name;
  const char* meaning;
};
constexpr std::array kModes{
    Mode{"off", "The plots follow the newest samples"},
    Mode{"auto", "At the newest contact, or at the newest samples when there is none for a while"},
    Mode{"normal", "At the newest contact, until the next one"},
    Mode{"single", "At the next contact, then frozen; Arm waits for the next one"}};

void draw_arrangement(const PanelContext& context) {
  PlotArrangement& arrangement = context.plots.persisted.arrangement;
  ImGui::SetNextItemWidth(ems(kArrangementEms));
  if (ImGui::BeginCombo("##arrangement", arrangement_of(arrangement).name)) {
    for (std::size_t i = 0; i < kArrangements.size(); ++i) {
      const auto choice = static_cast<PlotArrangement>(i);
      if (list_choice(kArrangements[i].name, choice == arrangement, kArrangements[i].meaning))
        arrangement = choice;
    }
    ImGui::EndCombo();
  } else {
    explain("Which plots are shown");
  }
}

void draw_loop_button(const PanelContext& context) {
  bool& phase = context.plots.persisted.phase.shown;
  if (choice_button(context, "Loop###phase plane", phase,
                    "Force over penetration; the area of the loop is energy"))
    phase = !phase;
}

void draw_spectrum_button(const PanelContext& context) {
  bool& shown = context.plots.persisted.spectrum.shown;
  if (choice_button(context, "FFT###spectrum", shown,
                    "The spectrum: amplitudes over frequency of a signal in the visible range,\n"
                    "or between the cursors while these are shown"))
    shown = !shown;
}

void toggle_follow(TimeView& time) { time.follow = !time.follow; }

void draw_follow(const PanelContext& context) {
  const bool following = context.time.follow;
  const bool single = context.plots.persisted.trigger.mode == draw::TriggerMode::kSingle;
  const char* label = following ? "Freeze###follow" : single ? "Arm###follow" : "Follow###follow";
  const char* tooltip = following ? "The plots follow the session: stops them (key F). A drag or "
                                    "the wheel in a plot does it, too."
                                  : "Back to the newest samples, or to the next contact (key F)";
  if (button(label, tooltip, {.width = ems(kFollowEms)})) toggle_follow(context.time);
}

std::string length_text(double length_s) {
  constexpr double kMinuteS = 60.0;
  constexpr double kHourS = 3600.0;
  if (length_s >= kHourS) return fmt::format("{:g} h", length_s / kHourS);
  if (length_s >= kMinuteS) return fmt::format("{:g} min", length_s / kMinuteS);
  if (length_s < 0.5) return fmt::format("{:g} ms", length_s * 1e3);
  return fmt::format("{:g} s", length_s);
}

// "auto, 200 ms" while the length follows the rhythm of a contact.
std::string length_choice_text(const TimeView& time) {
  const std::string now = length_text(window_length_s(time));
  return time.follows_rhythm && time.rhythm_s ? "auto, " + now : now;
}

void draw_length(const PanelContext& context) {
  TimeView& time = context.time;
  ImGui::SetNextItemWidth(ems(kWindowEms));
  if (!ImGui::BeginCombo("##time window", length_choice_text(time).c_str(),
                         ImGuiComboFlags_HeightLarge)) {
    explain("The length of the time axes");
    return;
  }
  if (list_choice("auto###length auto", time.follows_rhythm,
                  "About ten periods while a contact oscillates, and the length below otherwise")) {
    time.follows_rhythm = !time.follows_rhythm;
    time.follow = true;
  }
  for (const double choice_s : kTimeWindowsS) {
    const std::string text = length_text(choice_s);
    if (list_choice(fmt::format("{0}###length {0}", text), choice_s == time.window_s)) {
      time.window_s = choice_s;
      // A length that an oscillation would hide is asked for.
      time.follows_rhythm = time.follows_rhythm && !time.rhythm_s;
      time.follow = true;
    }
  }
  ImGui::EndCombo();
}

std::vector<draw::ValueAxis*> value_axes(PlotsState::Transient& plots) {
  std::vector<draw::ValueAxis*> all{&plots.phase.penetration, &plots.phase.force};
  for (draw::PlotAxes& axes : plots.axes)
    all.insert(all.end(), {&axes.left, &axes.right, &axes.far_right});
  return all;
}

void draw_automatic(const PanelContext& context) {
  const auto axes = value_axes(context.plots.transient);
  if (button("Auto###automatic axes",
             "Fits all value axes again. The wheel or a drag over an axis, or a right drag in a "
             "plot, fixes them; a double click makes one plot automatic.",
             {.enabled = std::ranges::any_of(axes, &draw::ValueAxis::manual)}))
    for (draw::ValueAxis* axis : axes) axis->manual = false;
}

void set_mode(const PanelContext& context, draw::TriggerMode mode) {
  context.plots.persisted.trigger.mode = mode;
  context.plots.transient.trigger = {};
  context.plots.transient.was_following = false;  // arms it
  context.time.follow = true;
}

// Names in the order of TriggerStage.
constexpr std::array kStages{"waiting", "filling", "contact", "done"};

void draw_trigger_choices(const PanelContext& context) {
  draw::TriggerSettings& settings = context.plots.persisted.trigger;
  ImGui::TextDisabled("The time axes stand at a contact");
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    const auto mode = static_cast<draw::TriggerMode>(i);
    if (ImGui::RadioButton(fmt::format("{0}###trigger {0}", kModes[i].name).c_str(),
                           settings.mode == mode))
      set_mode(context, mode);
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
  const draw::TriggerSettings& settings = context.plots.persisted.trigger;
  const bool on = settings.mode != draw::TriggerMode::kOff;
  const std::string label =
      on ? fmt::format("{}: {}###trigger", kModes[static_cast<std::size_t>(settings.mode)].name,
                       kStages.at(static_cast<std::size_t>(context.plots.transient.trigger.stage)))
         : "Trigger###trigger";
  if (choice_button(context, label, on,
                    "Holds the time axes at the newest contact, like a scope (key T)",
                    {.width = ems(kTriggerEms)}))
    ImGui::OpenPopup("trigger");
  if (ImGui::BeginPopup("trigger")) {
    draw_trigger_choices(context);
    ImGui::EndPopup();
  }
}

void toggle_cursors(const PanelContext& context) {
  draw::Cursors& cursors = context.plots.transient.cursors;
  cursors.shown = !cursors.shown;
  if (cursors.shown) place_cursors(cursors, time_window(context.time));
}

void draw_cursors_button(const PanelContext& context) {
  if (choice_button(context, "Cursors###cursors", context.plots.transient.cursors.shown,
                    "Two cursors to drag, and the signals at them (key C)"))
    toggle_cursors(context);
}

struct Control {
  void (*draw)(const PanelContext&);
  float width_ems;
};
constexpr std::array kControls{Control{draw_arrangement, kArrangementEms},
                               Control{draw_loop_button, kTextButtonEms},
                               Control{draw_spectrum_button, kTextButtonEms},
                               Control{draw_follow, kFollowEms},
                               Control{draw_length, kWindowEms},
                               Control{draw_automatic, kTextButtonEms},
                               Control{draw_trigger, kTriggerEms},
                               Control{draw_cursors_button, kFollowEms}};

void draw_exports(const PanelContext& context, const draw::SampleHistory& history) {
  const float width = 2.0F * ems(kExportEms) + ImGui::GetStyle().ItemSpacing.x;
  draw::align_right(width);
  const bool busy = context.plots.transient.exporting.running();
  if (button(busy ? "…###export csv" : "CSV###export csv",
             "Writes the samples of the visible range like a recording: CSV and sidecar",
             {.width = ems(kExportEms), .enabled = !busy && !history.empty()}))
    export_samples(context, history);
  ImGui::SameLine();
  if (button("PNG###export png", "Draws the plots of the visible range for print into a PNG file",
             {.width = ems(kExportEms), .enabled = !history.empty()}))
    export_figure(context, history);
}

}  // namespace

std::span<const draw::PlotId> plots_of(PlotArrangement arrangement) {
  return arrangement_of(arrangement).plots;
}

void draw_plot_controls(const PanelContext& context, const draw::SampleHistory& history) {
  if (!context.window.more) return;
  draw_axis_choice(context, "plots");
  for (const Control& control : kControls) {
    if (&control != kControls.data()) beside(ems(control.width_ems));
    control.draw(context);
  }
  if (!context.can.files) return;
  beside(2.0F * ems(kExportEms) + ImGui::GetStyle().ItemSpacing.x);
  draw_exports(context, history);
}

std::vector<KeyBinding> plot_keys() {
  const auto next_mode = [](const PanelContext& context) {
    const auto mode = static_cast<std::size_t>(context.plots.persisted.trigger.mode);
    set_mode(context, static_cast<draw::TriggerMode>((mode + 1) % kModes.size()));
  };
  return {
      {KeyGroup::kPlots,
       "follow the newest samples, or freeze",
       {ImGuiKey_F},
       [](const PanelContext& context) { toggle_follow(context.time); }},
      {KeyGroup::kPlots, "the next kind of trigger", {ImGuiKey_T}, next_mode},
      {KeyGroup::kPlots, "show or hide the cursors", {ImGuiKey_C}, [](const PanelContext& context) {
         toggle_cursors(context);
       }}};
}

}  // namespace hapticwall::ui
