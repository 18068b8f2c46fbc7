#include "app/ui/page/derived_controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "app/draw/plot/derived_signals.h"
#include "app/ui/page/plot_controls.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

using draw::DerivedKind;
using draw::DerivedSignal;

constexpr const char* kRefusalKey = "derived signal";
constexpr float kPopupEms = 24.0F;

void draw_present(const PanelContext& context) {
  PlotsState::Persisted& plots = context.state.plots.persisted;
  for (std::size_t place = 0; place < plots.derived.size(); ++place) {
    if (!plots.derived[place]) continue;
    const std::string name = derived_name(*plots.derived[place]);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name.c_str());
    ImGui::SameLine();
    const std::string label = fmt::format("Remove###remove {}", name);
    draw::align_right(button_width(label.c_str()));
    if (button(label, "Removes this line from its plot"))
      remove_derived(place, plots.derived, plots.lines, context.state.persisted.hidden_lines);
  }
}

void draw_kind(const PanelContext& context, DerivedKind& kind) {
  field_label(context, "kind", "", "");
  if (!ImGui::BeginCombo("##derived kind", kind_text(kind).name.data())) return;
  for (std::size_t i = 0; i < draw::kDerivedKinds.size(); ++i) {
    const auto choice = static_cast<DerivedKind>(i);
    const draw::DerivedKindText& text = kind_text(choice);
    if (list_choice(fmt::format("{0}###derived kind {0}", text.name), choice == kind, text.meaning))
      kind = choice;
  }
  ImGui::EndCombo();
}

void draw_signal(const PanelContext& context, const char* label, draw::Quantity& chosen) {
  field_label(context, label, "", "");
  const char* name = draw::usual_plots().find(chosen)->line->name;
  if (!ImGui::BeginCombo(fmt::format("##derived {}", label).c_str(), name)) return;
  for (const draw::PlotId id : draw::kAllPlots) {
    for (const draw::PlotLine& line : draw::plot_description(id).lines) {
      if (line.is_truth() && !context.session.knows_truth()) continue;
      if (list_choice(fmt::format("{0}###derived {1} {0}", line.name, label),
                      line.quantity == chosen, line.meaning))
        chosen = line.quantity;
    }
  }
  ImGui::EndCombo();
}

void draw_mean_time(const PanelContext& context, double& over_s) {
  field_label(context, "over",
              "The time that ends at each sample: one tick to the time axes' length", "s");
  if (const auto typed = number_field(context, "##derived over", over_s)) over_s = *typed;
  unit_label("s");
}

// Its plot may be one that the arrangement leaves out.
void tell_hidden_plot(const PanelContext& context, const DerivedSignal& signal) {
  const draw::PlotDescription& plot = *draw::usual_plots().find(signal.a)->plot;
  const auto shown = plots_of(context.state.persisted.arrangement);
  if (std::ranges::find(shown, plot.id) != shown.end()) return;
  tell(context.state, MessageKind::kNote,
       fmt::format("{} is in the plot {}, which is not shown: choose all plots",
                   derived_name(signal), plot.title));
}

void add(const PanelContext& context, const DerivedSignal& signal) {
  PlotsState::Persisted& plots = context.state.plots.persisted;
  const draw::MeanLimits limits{context.session.scene().sampling.period_s(),
                                context.state.persisted.time_window_s};
  if (const auto problem = derived_problem(signal, limits))
    return refuse(context, kRefusalKey, *problem);
  if (!add_derived(signal, plots.derived, plots.lines))
    return refuse(context, kRefusalKey, "this line is there already");
  context.state.transient.refusal.reset();
  tell_hidden_plot(context, signal);
}

}  // namespace

void draw_derived_signals(const PanelContext& context) {
  DerivedSignal& next = context.state.plots.transient.next_derived;
  const draw::DerivedSignals& all = context.state.plots.persisted.derived;
  ImGui::Dummy(ImVec2(ems(kPopupEms), 0.0F));
  draw_present(context);
  if (std::ranges::find(all, std::optional<DerivedSignal>()) == all.end())
    return muted_text(context, "That is all there is room for.");
  draw_kind(context, next.kind);
  draw_signal(context, "of", next.a);
  if (next.kind == DerivedKind::kDifference) draw_signal(context, "minus", next.b);
  if (next.kind == DerivedKind::kMean) draw_mean_time(context, next.over_s);
  draw_refusal(context, kRefusalKey);
  if (button("Add###add derived", "Draws it in the plot of its signal")) add(context, next);
}

}  // namespace hapticwall::ui
