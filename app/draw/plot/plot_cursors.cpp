#include "app/draw/plot/plot_cursors.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <string>

namespace hapticwall::draw {
namespace {

constexpr std::array kShares{1.0 / 3.0, 2.0 / 3.0};  // of the window

// Digits of constant width, flush right.
void number_cell(const std::string& text) {
  ImGui::TableNextColumn();
  right_aligned_text(text);
}

void text_cell(const ImVec4& colour, const char* text) {
  ImGui::TableNextColumn();
  ImGui::TextColored(colour, "%s", text);
}

void draw_times(const Theme& theme, const CursorTable& table) {
  const ImVec4 muted = theme.colour(Tone::kMuted);
  text_cell(muted, "time");
  number_cell(fmt::format("{:.4f}", table.time_s[0]));
  number_cell(fmt::format("{:.4f}", table.time_s[1]));
  number_cell(fmt::format("{:.4f}", table.difference_s()));
  text_cell(muted, "s");
  const auto rate_hz = table.rate_hz();
  if (!rate_hz) return;
  ImGui::TableNextRow();
  text_cell(muted, "1/Δt");
  ImGui::TableNextColumn();
  ImGui::TableNextColumn();
  number_cell(fmt::format("{:.5g}", *rate_hz));
  text_cell(muted, "Hz");
}

}  // namespace

void place_cursors(Cursors& cursors, TimeWindow window) {
  for (std::size_t i = 0; i < kShares.size(); ++i)
    cursors.time_s[i] = window.from_s + kShares[i] * window.length_s();
}

void carry_cursors(Cursors& cursors, TimeWindow from, TimeWindow to) {
  if (from.length_s() <= 0.0) return;
  for (double& time_s : cursors.time_s)
    time_s = to.from_s + (time_s - from.from_s) / from.length_s() * to.length_s();
}

std::optional<double> CursorTable::rate_hz() const {
  const double difference = std::abs(difference_s());
  if (difference <= 0.0) return std::nullopt;
  return 1.0 / difference;
}

CursorTable read_cursors(const SampleHistory& history, const Cursors& cursors,
                         std::span<const PlotId> plots, const ChosenLines& chosen,
                         HiddenLines hidden) {
  CursorTable table;
  if (history.empty()) return table;
  std::array<std::size_t, 2> index{};
  for (std::size_t i = 0; i < index.size(); ++i) {
    index[i] = *history.nearest(cursors.time_s[i]);
    table.time_s[i] = history.value(&Sample::time_s, index[i]);
  }
  for (const PlotId id : plots) {
    const PlotDescription& plot = plot_description(id);
    const LineSet shown = chosen[static_cast<std::size_t>(id)] & ~hidden;
    for (const PlotLine& line : plot.lines) {
      if ((shown & line_bit(line.quantity)) == 0U) continue;
      const ValueScale& scale = plot.scale_of(line);
      table.rows.push_back({&line,
                            scale.unit,
                            {history.value(line.quantity, index[0]) * scale.scale,
                             history.value(line.quantity, index[1]) * scale.scale}});
    }
  }
  return table;
}

void draw_cursor_table(const Theme& theme, const CursorTable& table) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX |
                                     ImGuiTableFlags_ScrollY | ImGuiTableFlags_NoHostExtendX;
  const FontScope font(theme.fonts.digits, kSmallFontSize);
  if (!ImGui::BeginTable("##cursors", 5, kFlags)) return;
  ImGui::TableSetupScrollFreeze(1, 1);
  const ImVec4 muted = theme.colour(Tone::kMuted);
  ImGui::TableNextRow();
  for (const char* title : {"", "A", "B", "B − A", ""}) text_cell(muted, title);
  ImGui::TableNextRow();
  draw_times(theme, table);
  for (const CursorRow& row : table.rows) {
    ImGui::TableNextRow();
    text_cell(theme.colour(row.line->tone), row.line->name);
    for (const double value : {row.value[0], row.value[1], row.difference()})
      number_cell(fmt::format("{:#.5g}", value));
    text_cell(muted, row.unit);
  }
  ImGui::EndTable();
}

}  // namespace hapticwall::draw
