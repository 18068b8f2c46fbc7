#include <fmt/format.h>
#include <implot.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/draw/plot/plot_axes.h"
#include "app/draw/verdict/tail.h"
#include "app/file/text/verdict.h"
#include "app/ui/computed/all_runs.h"
#include "app/ui/page/pages.h"
#include "app/ui/state/model_runs.h"
#include "app/ui/widget/widgets.h"
#include "core/units.h"

namespace hapticwall::ui {
namespace {

constexpr float kMinFieldEms = 16.0F;  // width
constexpr float kMinHeightEms = 9.0F;
constexpr double kSmallestSpanMm = 0.5;

// Common range of all runs, so that the fields can be compared. A run that diverged goes beyond it.
draw::Extremes span_mm(std::span<const AlgorithmRun> runs) {
  std::optional<draw::Extremes> all;
  for (const AlgorithmRun& run : runs) {
    if (run.summary.verdict == Verdict::kDiverged || run.position_m.value.empty()) continue;
    const auto [low, high] = std::ranges::minmax(run.position_m.value);
    const draw::Extremes own{low * kMillimetresPerMetre, high * kMillimetresPerMetre};
    if (all) {
      all->include(own);
    } else {
      all = own;
    }
  }
  return draw::round_range(all.value_or(draw::Extremes{}), kSmallestSpanMm);
}

void draw_trace(const PanelContext& context, const AlgorithmRun& run, draw::Extremes span,
                ImVec2 size) {
  if (!ImPlot::BeginPlot("##trace", size, draw::plot_flags(false))) return;
  const double end_s = run.summary.duration_s;
  ImPlot::SetupAxis(ImAxis_X1, nullptr, draw::kAxisFlags);
  ImPlot::SetupAxis(ImAxis_Y1, nullptr, draw::kAxisFlags);
  ImPlot::SetupAxisFormat(ImAxis_X1, "%g s");
  ImPlot::SetupAxisFormat(ImAxis_Y1, "%g mm");
  ImPlot::SetupAxisLimits(ImAxis_X1, std::max(end_s - kTraceS, 0.0), end_s, ImPlotCond_Always);
  ImPlot::SetupAxisLimits(ImAxis_Y1, span.minimum, span.maximum, ImPlotCond_Always);
  ImPlot::SetupFinish();
  draw::Trace trace = run.position_m;
  for (double& value : trace.value) value *= kMillimetresPerMetre;
  ImPlot::PlotLine("position", trace.time_s.data(), trace.value.data(),
                   static_cast<int>(trace.time_s.size()),
                   draw::line_spec(context.theme.colour(draw::Tone::kPosition)));
  ImPlot::EndPlot();
}

// The verdict in two lines: the motion, then force and stiffness.
std::string verdict_lines(const Summary& summary) {
  const file::TailTexts tail = file::tail_texts(summary);
  return fmt::format("{} · {}\n{} · {}", file::verdict_text(summary), tail.way, tail.force,
                     tail.stiffness);
}

void draw_run(const PanelContext& context, const AlgorithmRun& run, draw::Extremes span,
              ImVec2 size) {
  const bool in_force = context.session.scene().algorithm == run.algorithm.settings;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (choice_button(context, fmt::format("{0}###all {0}", run.algorithm.label), in_force,
                    "Puts this algorithm in force, with its parameters.",
                    {.width = size.x, .enabled = context.shows.live != nullptr})) {
    Scene wanted = context.session.scene();
    wanted.algorithm = run.algorithm.settings;
    make_running(context, wanted);
  }
  {
    const FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x);
    ImGui::TextColored(context.theme.colour(draw::verdict_tone(run.summary.verdict)), "%s",
                       verdict_lines(run.summary).c_str());
    ImGui::PopTextWrapPos();
  }
  const float used = ImGui::GetCursorScreenPos().y - corner.y;
  const FontScope font(nullptr, draw::kSmallFontSize);
  draw_trace(context, run, span, ImVec2(size.x, size.y - used));
}

void draw_runs(const PanelContext& context, std::span<const AlgorithmRun> runs) {
  const ImVec2 free = ImGui::GetContentRegionAvail();
  const float gap = ImGui::GetFontSize();
  const auto fit = static_cast<std::size_t>((free.x + gap) / (ems(kMinFieldEms) + gap));
  const std::size_t columns = std::clamp<std::size_t>(fit, 1, (runs.size() + 1) / 2);
  const std::size_t rows = (runs.size() + columns - 1) / columns;
  const ImVec2 each((free.x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns),
                    std::max(free.y / static_cast<float>(rows), ems(kMinHeightEms)));
  const draw::Extremes span = span_mm(runs);
  const ImVec2 corner = ImGui::GetCursorPos();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t row = i / columns;
    ImGui::SetCursorPos(ImVec2(corner.x + static_cast<float>(i % columns) * (each.x + gap),
                               corner.y + static_cast<float>(row) * each.y));
    ImGui::PushID(static_cast<int>(i));
    ImGui::BeginGroup();
    draw_run(context, runs[i], span, each);
    ImGui::EndGroup();
    ImGui::PopID();
  }
}

}  // namespace

void draw_all_page(const PanelContext& context, AllRuns& all) {
  if (const std::string why = why_no_runs(context); !why.empty()) {
    all.stop();
    return muted_text(context, why);
  }
  all.take();
  if (!(scene_in_motion() && all.running())) all.ask_for(context.session.scene());
  if (!all.problem().empty()) {
    return draw::wrapped_text(context.theme.colour(draw::Tone::kBad), all.problem());
  }
  if (all.runs().empty()) {
    return muted_text(context, fmt::format("computing … {:.0f} %", 100.0 * all.fraction()));
  }
  // The runs of the scene before are dimmed.
  ImGui::PushStyleVar(
      ImGuiStyleVar_Alpha,
      ImGui::GetStyle().Alpha * (all.up_to_date() ? 1.0F : ImGui::GetStyle().DisabledAlpha));
  draw_runs(context, all.runs());
  ImGui::PopStyleVar();
}

}  // namespace hapticwall::ui
