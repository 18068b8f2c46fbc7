#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/draw/plot/log_plot.h"
#include "app/file/text/text.h"
#include "app/table/order.h"
#include "app/ui/computed/study_state.h"
#include "app/ui/page/pages.h"
#include "app/ui/state/frame_input.h"
#include "app/ui/state/model_runs.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

constexpr float kMinBarEms = 16.0F;
constexpr float kMinDiagramEms = 20.0F;
constexpr float kDiagramShare = 0.7F;  // share of the page's height

std::string why_no_study(const PanelContext& context) {
  if (context.shows.hides_force) return "Hidden until the blind test ends.";
  if (context.shows.replay != nullptr) {
    return "This page computes studies of a running scene, and a recording is shown. Go back to "
           "the scene.";
  }
  return why_no_runs(context);
}

void draw_study_choice(const PanelContext& context, Studies& studies) {
  for (std::size_t i = 0; i < studies.all.size(); ++i) {
    const study::Study& study = studies.all[i].study();
    if (choice_button(context, fmt::format("{}###study {}", study.title, study.name),
                      studies.choice == i, study.about))
      studies.choice = i;
    ImGui::SameLine();
  }
}

void draw_start_or_end(const PanelContext& context, Studies& studies) {
  SceneStudy& study = studies.shown();
  if (study.running()) {
    if (button("End###study compute", "Ends the computation. A result that has come stays."))
      study.stop();
  } else if (button("Compute###study compute",
                    "Computes this table of the present scene, beside the session. It ends with "
                    "the page, with a change of the scene, and with another study.")) {
    studies.stop();
    study.start(context.session.scene(), context.input.now_s);
  }
}

void draw_copies(const study::Outcome* result) {
  if (button("Copy###study copy", "Copies the table as text, as the command line prints it",
             {.enabled = result != nullptr}))
    ImGui::SetClipboardText(table::sheet_text(result->sheet).c_str());
  ImGui::SameLine();
  if (button("Copy CSV###study csv", "Copies the table as CSV, with all digits, in SI units",
             {.enabled = result != nullptr}))
    ImGui::SetClipboardText(result->csv.c_str());
}

std::string progress_text(const SceneStudy& study, double now_s) {
  const double fraction = study.fraction();
  const double elapsed_s = study.elapsed_s(now_s);
  std::string text = fmt::format("{}{:.0f} %, {:.1f} s", study.coarse() ? "coarse: " : "",
                                 100.0 * fraction, elapsed_s);
  constexpr double kEnough = 0.02;  // share of the work that is enough for an estimate
  if (fraction > kEnough) text += fmt::format(" of about {:.1f} s", elapsed_s / fraction);
  return text;
}

std::string state_text(const SceneStudy& study) {
  if (study.result() == nullptr) return "not computed yet";
  std::string text = fmt::format("{}, in {:.1f} s", study.complete() ? "complete" : "coarse: ended",
                                 study.spent_s());
  if (!study.up_to_date()) text += "; of the scene before";
  return text;
}

void draw_state(const PanelContext& context, const SceneStudy& study) {
  if (!study.running()) return muted_text(context, state_text(study));
  progress_bar(context, study.fraction(), progress_text(study, context.input.now_s));
}

void draw_lines(const PanelContext& context, const std::string& lines) {
  const FontScope font(nullptr, draw::kSmallFontSize);
  if (!lines.empty()) muted_text(context, lines.substr(0, lines.size() - 1));
}

// The cell, padded to the longest one of its column in digits of constant width, so that numbers
// align.
std::string padded(const table::Sheet& sheet, std::size_t column, const std::string& cell) {
  if (sheet.columns[column].align == table::Align::kLeft) return cell;
  std::size_t width = 0;
  for (const auto& row : sheet.rows) width = std::max(width, row[column].size());
  return std::string(width - cell.size(), ' ') + cell;
}

std::vector<std::size_t> rows_in_order(const table::Sheet& sheet) {
  const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs != nullptr && specs->SpecsCount > 0) {
    return table::ordered(sheet, static_cast<std::size_t>(specs->Specs->ColumnIndex),
                          specs->Specs->SortDirection == ImGuiSortDirection_Descending);
  }
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < sheet.rows.size(); ++i) rows.push_back(i);
  return rows;
}

void draw_cells(const table::Sheet& sheet) {
  for (const std::size_t row : rows_in_order(sheet)) {
    ImGui::TableNextRow();
    for (std::size_t column = 0; column < sheet.columns.size(); ++column) {
      if (!ImGui::TableNextColumn()) continue;
      ImGui::TextUnformatted(padded(sheet, column, sheet.rows[row][column]).c_str());
    }
  }
}

void set_up_columns(const table::Sheet& sheet) {
  ImGui::TableSetupScrollFreeze(1, 1);
  for (const table::Sheet::Head& column : sheet.columns) {
    const std::string title(file::trimmed(column.title));
    const std::string unit(file::trimmed(column.unit));
    ImGui::TableSetupColumn(
        fmt::format("{0}{1}{2}###study column {0}", title, unit.empty() ? "" : ", ", unit).c_str());
  }
}

// All rows; the page scrolls up and down, the table to the side.
void draw_table(const PanelContext& context, const std::string& name, const table::Sheet& sheet) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_ScrollX | ImGuiTableFlags_RowBg | ImGuiTableFlags_Sortable |
      ImGuiTableFlags_SortTristate | ImGuiTableFlags_SizingFixedFit |
      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_NoSavedSettings;
  const FontScope font(context.theme.fonts.digits, draw::kSmallFontSize);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float line = ImGui::GetTextLineHeight() + 2.0F * style.CellPadding.y;
  const float height =
      line * static_cast<float>(sheet.rows.size() + 1) + style.ScrollbarSize + 2.0F;
  if (!ImGui::BeginTable(name.c_str(), static_cast<int>(sheet.columns.size()), kFlags,
                         ImVec2(0.0F, height)))
    return;
  set_up_columns(sheet);
  ImGui::TableHeadersRow();
  draw_cells(sheet);
  ImGui::EndTable();
}

void draw_result(const PanelContext& context, const SceneStudy& study) {
  const study::Outcome& result = *study.result();
  draw_lines(context, result.sheet.heading);
  if (result.figure) {
    const ImVec2 free = ImGui::GetContentRegionAvail();
    const float height = std::max(kDiagramShare * free.y, ems(kMinDiagramEms));
    draw::draw_log_figure(context.theme, *result.figure, ImVec2(free.x, height),
                          ImGui::GetFontSize() / draw::kFontSize);
  }
  draw_table(context, std::string(study.study().name), result.sheet);
  draw_lines(context, result.sheet.marks);
}

}  // namespace

void draw_study_page(const PanelContext& context, Studies& studies) {
  if (const std::string why = why_no_study(context); !why.empty()) {
    studies.stop();
    return muted_text(context, why);
  }
  for (SceneStudy& each : studies.all) each.take(context.session.scene(), context.input.now_s);
  draw_study_choice(context, studies);
  draw_start_or_end(context, studies);
  const SceneStudy& study = studies.shown();
  ImGui::SameLine();
  draw_copies(study.result());
  beside(ems(kMinBarEms));
  draw_state(context, study);
  if (!study.problem().empty())
    draw::wrapped_text(context.theme.colour(draw::Tone::kBad), study.problem());
  if (study.result() == nullptr) return muted_text(context, study.study().about);
  // A result of the scene before is dimmed.
  ImGui::PushStyleVar(
      ImGuiStyleVar_Alpha,
      ImGui::GetStyle().Alpha * (study.up_to_date() ? 1.0F : ImGui::GetStyle().DisabledAlpha));
  draw_result(context, study);
  ImGui::PopStyleVar();
}

}  // namespace hapticwall::ui
