#include "app/ui/first/first_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/ui/panel/sections.h"
#include "app/ui/panel/toolbar.h"
#include "app/ui/panel/tour_strip.h"
#include "app/ui/state/tour.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::ui {
namespace {

constexpr float kHeadGapEms = 0.8F;

// "One hand, one wall of 35 kN/m, two algorithms."
std::string subject_of(const Scene& scene) {
  if (scene.x().walls.size() != 1) return scene.description;
  return fmt::format("One hand, one wall of {:.4g} kN/m, two algorithms",
                     scene.x().walls.front().stiffness_n_per_m / 1e3);
}

struct HeadButton {
  std::string label;
  const char* tooltip;
  void (*act)(const PanelContext&);
  bool chosen = false;
};

void open_more(const PanelContext& context) { show_more(context.window, context.plots); }

std::vector<HeadButton> head_buttons(const PanelContext& context) {
  return {{context.snapshot.paused ? "Run###pause" : "Pause###pause",
           "Pauses or runs the session (key P)", toggle_pause},
          {"From rest###reset", "Back to tick 0, at rest (key R)", ask_to_reset},
          {"Tour###begin tour", "Five lessons, a minute each", begin_tour,
           context.tour.step == 0 && context.tour.offered},
          {"More###more",
           "Every parameter, comparison, pages and plot controls. 'Less', at the same place, "
           "comes back.",
           open_more},
          {"?###help", "All keys (F1)", toggle_help}};
}

std::string chip_label(std::size_t index, bool whole) {
  std::string name(algorithms()[index].name);
  std::ranges::replace(name, '-', ' ');
  return whole ? fmt::format("{}  {}###{}", index + 1, name, algorithms()[index].name)
               : fmt::format("{}###{}", index + 1, algorithms()[index].name);
}

}  // namespace

void draw_first_head(const PanelContext& context) {
  const std::vector<HeadButton> buttons = head_buttons(context);
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  float width = -spacing;
  for (const HeadButton& each : buttons) width += button_width(each.label.c_str()) + spacing;
  ImGui::AlignTextToFramePadding();
  draw::strong_text(context.theme, "Haptic Wall", draw::kTitleFontSize);
  const std::string subject = subject_of(context.session.scene());
  const float free = ImGui::GetContentRegionAvail().x - ImGui::GetItemRectSize().x -
                     2.0F * ems(kHeadGapEms) - width;
  if (ImGui::CalcTextSize(subject.c_str()).x <= free) {
    ImGui::SameLine(0.0F, ems(kHeadGapEms));
    ImGui::TextColored(context.theme.colour(draw::Tone::kMuted), "%s", subject.c_str());
  }
  ImGui::SameLine();
  draw::align_right(width);
  for (const HeadButton& each : buttons) {
    const bool pressed = each.chosen ? choice_button(context, each.label, true, each.tooltip)
                                     : button(each.label, each.tooltip);
    if (each.act == ask_to_reset) point_at_reset(context);
    if (each.act == open_more) point_at(context, TourPlace::kMore);
    if (pressed) each.act(context);
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

void draw_first_chips(const PanelContext& context) {
  const std::size_t now = context.session.scene().algorithm.index;
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  float whole = -spacing;
  for (std::size_t i = 0; i < algorithms().size(); ++i)
    whole += button_width(chip_label(i, true).c_str()) + spacing;
  const bool fits = whole <= ImGui::GetContentRegionAvail().x;
  for (std::size_t i = 0; i < algorithms().size(); ++i) {
    const AlgorithmDescription& each = algorithms()[i];
    const std::string tooltip = fmt::format(
        "{}\n{}\n\nkey {}; changes the leading wall while it "
        "runs, without a jump of the force",
        each.title, each.idea, i + 1);
    const std::string label = chip_label(i, fits || i == now);
    if (i != 0) beside(button_width(label.c_str()));
    const bool pressed =
        i == now ? choice_button(context, label, true, tooltip) : button(label, tooltip);
    point_at_algorithm(context, i);
    if (pressed) choose_algorithm(context, i);
  }
}

}  // namespace hapticwall::ui
