#include "app/ui/panel/layout_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "app/file/text/text.h"
#include "app/ui/state/dock_state.h"
#include "app/ui/state/plots_state.h"
#include "app/ui/state/window_state.h"
#include "app/ui/widget/widgets.h"
#include "core/text.h"

namespace hapticwall::ui {
namespace {

constexpr const char* kRefusalKey = "layout name";
constexpr float kNameEms = 11.0F;
// A built-in layout of earlier versions. A presentation (F5) has taken its place.
constexpr std::string_view kFormerLayout = "lecture";

constexpr std::array kBuiltins{
    BuiltinLayout{
        "bench", "Parameters, wall, contact, and the pages behind tabs",
        "X21.5em(Controls;Y40%(X62%(Wall;Contact);Plots*,Blind test,Map,All at once,Study))",
        PlotArrangement::kAll},
    BuiltinLayout{"figure 4", "The three plots of Figure 4 of the paper, parameters, a small wall",
                  "X21.5em(Controls;Y22%(Wall;Plots))", PlotArrangement::kFigure4},
    BuiltinLayout{"figures 5 and 6",
                  "The three plots of Figures 5 and 6 of the paper, parameters, a small wall",
                  "X21.5em(Controls;Y22%(Wall;Plots))", PlotArrangement::kFigure5And6},
    BuiltinLayout{"experiment", "The blind test, the wall and the parameters",
                  "X21.5em(Controls;Y45%(Wall;Blind test))", std::nullopt, &Capabilities::files}};

const BuiltinLayout* builtin_called(std::string_view name) {
  const auto* found = std::ranges::find(
      kBuiltins, name, [](const BuiltinLayout& each) { return std::string_view(each.name); });
  return found == kBuiltins.end() ? nullptr : found;
}

std::optional<DockLayout> layout_called(const DockState& dock, const std::string& name) {
  if (const BuiltinLayout* builtin = builtin_called(name)) return parse_layout(builtin->text);
  const auto& own = dock.own_layouts;
  const auto found = std::ranges::find(own, name, &OwnLayout::name);
  return found == own.end() ? std::nullopt : std::optional(found->layout);
}

std::vector<std::string> layout_names(const PanelContext& context) {
  std::vector<std::string> names;
  for (const BuiltinLayout& each : kBuiltins) {
    if (has(context.can, each.needs)) names.emplace_back(each.name);
  }
  for (const OwnLayout& each : context.dock.own_layouts) names.push_back(each.name);
  return names;
}

bool has_control(std::string_view text) {
  for (; !text.empty(); text.remove_prefix(utf8_length(text))) {
    if (starts_with_control(text)) return true;
  }
  return false;
}

// Problem with the name, or nullopt.
std::optional<std::string> problem_with_name(const DockState& dock, std::string_view name) {
  const auto& own = dock.own_layouts;
  if (name.empty()) return "a layout needs a name";
  if (!is_utf8(name) || has_control(name)) return "a name has no control characters";
  if (name.size() > kMaxLayoutNameBytes)
    return fmt::format("a name has at most {} bytes", kMaxLayoutNameBytes);
  if (builtin_called(name) != nullptr)
    return fmt::format("'{}' is a built-in layout: choose another name", name);
  const bool is_new = std::ranges::find(own, name, &OwnLayout::name) == own.end();
  if (is_new && own.size() >= kMaxOwnLayouts)
    return fmt::format("there are {} layouts: delete one", kMaxOwnLayouts);
  return std::nullopt;
}

void show_layout(DockState& dock, DockLayout layout) {
  dock.chosen = std::move(layout);
  dock.rebuild = true;
}

void draw_names(const PanelContext& context) {
  for (const std::string& name : layout_names(context)) {
    const BuiltinLayout* builtin = builtin_called(name);
    if (list_choice(fmt::format("{0}###layout of {0}", name), context.dock.layout == name,
                    builtin != nullptr ? builtin->meaning : "A layout of your own"))
      choose_layout(context.dock, context.window, context.plots, name);
  }
}

void draw_keep(const PanelContext& context) {
  DockState& dock = context.dock;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("keep as");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ems(kNameEms));
  if (const auto name = text_field(context, "##layout name", "a name of your own", "")) {
    if (auto problem = keep_layout(dock, std::string(file::trimmed(*name))))
      refuse(context, kRefusalKey, *std::move(problem));
  }
  explain("Keeps the windows as they are now, in the settings file.");
  draw_refusal(context, kRefusalKey);
  const std::string now = dock.layout;
  if (builtin_called(now) == nullptr &&
      button(fmt::format("Delete '{}'###forget layout", now), "The windows stay where they are."))
    forget_layout(dock, now);
}

void open_or_close(DockState& dock, const std::string& window, bool open) {
  DockLayout layout = *dock.chosen;
  if (open) {
    bring_to_front(layout, window);
  } else {
    layout = without(layout, std::array{window});
  }
  dock.docked = layout_text(layout);
  show_layout(dock, std::move(layout));
}

void draw_windows(const PanelContext& context) {
  DockState& dock = context.dock;
  if (!context.window.more || !dock.chosen) return;
  const std::vector<std::string> shown = windows_of(*dock.chosen);
  ImGui::Separator();
  ImGui::TextDisabled("windows");
  for (const DockWindow& window : dock.windows) {
    bool open = std::ranges::find(shown, window.name) != shown.end();
    if (ImGui::Checkbox(fmt::format("{0}###window {0}", window.name).c_str(), &open))
      open_or_close(dock, window.name, open);
    explain(window.meaning);
  }
}

}  // namespace

std::span<const BuiltinLayout> builtin_layouts() { return kBuiltins; }

void restore_layout(DockState& dock, Toasts& toasts) {
  if (!layout_called(dock, dock.layout)) {
    if (dock.layout != kFormerLayout) {
      toasts.tell(
          MessageKind::kProblem,
          fmt::format("there is no layout '{}' any more: this is '{}'", dock.layout, kUsualLayout));
    }
    dock.layout = kUsualLayout;
    dock.docked.clear();
  }
  const std::optional<DockLayout> kept_as = parse_layout(dock.docked);
  show_layout(dock, dock.docked.empty() || !kept_as ? *layout_called(dock, dock.layout) : *kept_as);
}

void choose_layout(DockState& dock, WindowState& window, PlotsState& plots,
                   const std::string& name) {
  window.more = true;
  window.presents = false;
  dock.layout = name;
  dock.docked.clear();
  show_layout(dock, *layout_called(dock, name));
  const BuiltinLayout* builtin = builtin_called(name);
  if (builtin != nullptr && builtin->arrangement)
    plots.persisted.arrangement = *builtin->arrangement;
}

void choose_next_layout(const PanelContext& context) {
  const std::vector<std::string> names = layout_names(context);
  const auto now = std::ranges::find(names, context.dock.layout);
  const bool last = now == names.end() || std::next(now) == names.end();
  choose_layout(context.dock, context.window, context.plots,
                last ? names.front() : *std::next(now));
}

std::optional<std::string> keep_layout(DockState& dock, const std::string& name) {
  if (auto problem = problem_with_name(dock, name)) return problem;
  auto& own = dock.own_layouts;
  auto place = std::ranges::find(own, name, &OwnLayout::name);
  if (place == own.end()) place = own.insert(own.end(), {name, {}});
  place->layout = dock.chosen.value_or(DockLayout{});
  dock.layout = name;
  dock.docked.clear();
  return std::nullopt;
}

void forget_layout(DockState& dock, const std::string& name) {
  std::erase_if(dock.own_layouts, [&](const OwnLayout& each) { return each.name == name; });
  if (dock.layout != name) return;
  dock.layout = kUsualLayout;
  dock.docked = layout_text(*dock.chosen);
}

void draw_layout_choice(const PanelContext& context) {
  if (context.shows.hides_algorithm) return;
  const bool open = ImGui::BeginCombo(
      "##layout", context.window.more ? context.dock.layout.c_str() : "first minute",
      ImGuiComboFlags_HeightLargest);
  if (!open) {
    explain("Layout of the windows (key F3). Drag a tab to move its window, a gap to resize two.");
    return;
  }
  draw_names(context);
  ImGui::Separator();
  if (context.can.files) draw_keep(context);
  draw_windows(context);
  ImGui::EndCombo();
}

}  // namespace hapticwall::ui
