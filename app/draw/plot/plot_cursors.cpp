#include "app/draw/plot/plot_cursors.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr std::array kShares{1.0 / 3.0, 2.0 / 3.0};  // positions as shares of the window

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

CursorRow row_of(const SampleHistory& history, const PlotLine& line, const ValueScale& scale,
                 const std::array<std::size_t, 2>& index) {
  const auto [first, last] = std::minmax(index[0], index[1]);
  const IndexRange between{first, last + 1};
  const SampleStats stats = history.stats(line.quantity, between);
  const double variance = history.variance(line.quantity, between);
  const double mean = stats.mean();
  CursorRow row{&line, scale.unit};
  for (std::size_t i = 0; i < index.size(); ++i)
    row.value[i] = history.value(line.quantity, index[i]) * scale.scale;
  row.mean = mean * scale.scale;
  row.deviation = (stats.empty() ? kMasked : std::sqrt(variance)) * scale.scale;
  row.peak_to_peak =
      (stats.empty() ? kMasked : stats.extremes.maximum - stats.extremes.minimum) * scale.scale;
  row.rms = std::sqrt(mean * mean + variance) * scale.scale;
  return row;
}

std::string number_text(double value) {
  return std::isnan(value) ? "–" : fmt::format("{:#.5g}", value);
}

constexpr ImGuiTableFlags kTableFlags =
    ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX;

void draw_statistics(const Theme& theme, const CursorTable& table) {
  if (!ImGui::BeginTable("##statistics", 7, kTableFlags)) return;
  const ImVec4 muted = theme.colour(Tone::kMuted);
  ImGui::TableNextRow();
  for (const char* title : {"A to B", "mean", "deviation", "p-p", "RMS", "per s", ""})
    text_cell(muted, title);
  const double length_s = table.difference_s();
  for (const CursorRow& row : table.rows) {
    ImGui::TableNextRow();
    text_cell(theme.colour(row.line->tone), row.line->name);
    const double rate = length_s != 0.0 ? row.difference() / length_s : kMasked;
    for (const double value : {row.mean, row.deviation, row.peak_to_peak, row.rms, rate})
      number_cell(number_text(value));
    text_cell(muted, row.unit);
  }
  ImGui::EndTable();
  ImGui::TextColored(muted, "∫ F_d dx  %.4g mJ from the handle to the actuator",
                     table.energy_j * kMillijoulesPerJoule);
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
                         HiddenLines hidden, bool simulated, const PlotTable& plot_table) {
  CursorTable table;
  if (history.empty()) return table;
  std::array<std::size_t, 2> index{};
  for (std::size_t i = 0; i < index.size(); ++i) {
    index[i] = *history.nearest(cursors.time_s[i]);
    table.time_s[i] = history.value(&Sample::time_s, index[i]);
  }
  table.energy_j = history.value(&Sample::energy_scv_j, index[1]) -
                   history.value(&Sample::energy_scv_j, index[0]);
  for (const PlotId id : plots) {
    const PlotDescription& plot = plot_table[id];
    const LineSet shown = chosen[static_cast<std::size_t>(id)] & ~hidden;
    for (const PlotLine& line : plot.lines) {
      if ((shown & line_bit(line.quantity)) == 0U) continue;
      if (line.is_truth() && !simulated) continue;
      table.rows.push_back(row_of(history, line, plot.scale_of(line), index));
    }
  }
  return table;
}

void draw_cursor_table(const Theme& theme, const CursorTable& table) {
  const FontScope font(theme.fonts.digits, kSmallFontSize);
  if (!ImGui::BeginTable("##cursors", 5, kTableFlags)) return;
  const ImVec4 muted = theme.colour(Tone::kMuted);
  ImGui::TableNextRow();
  for (const char* title : {"", "A", "B", "B − A", ""}) text_cell(muted, title);
  ImGui::TableNextRow();
  draw_times(theme, table);
  for (const CursorRow& row : table.rows) {
    ImGui::TableNextRow();
    text_cell(theme.colour(row.line->tone), row.line->name);
    for (const double value : {row.value[0], row.value[1], row.difference()})
      number_cell(number_text(value));
    text_cell(muted, row.unit);
  }
  ImGui::EndTable();
  draw_statistics(theme, table);
}

}  // namespace hapticwall::draw
