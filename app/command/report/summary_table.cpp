#include "app/command/report/summary_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "app/file/text/verdict.h"
#include "app/table/hand_column.h"
#include "app/table/text_table.h"
#include "core/run/metrics.h"
#include "core/units.h"

namespace hapticwall::command {
namespace {

constexpr std::size_t kLabelWidth = 22;
constexpr std::string_view kHandMoves =
    "the hand's script still moves in the last second: peak to peak includes its way";

std::string millimetres(std::optional<double> value_m) {
  return file::fixed(value_m, kMillimetresPerMetre, 3);
}
std::string millijoules(std::optional<double> value_j) {
  return file::fixed(value_j, kMillijoulesPerJoule, 2);
}
std::string newtons(std::optional<double> value_n) { return file::fixed(value_n, 1.0, 3); }

std::string speed_text(const Summary& summary) {
  if (!summary.simulated_seconds_per_second || !summary.ns_per_tick) return "";
  return fmt::format(", {:.3g} times real time, {:.3g} ns a tick",
                     *summary.simulated_seconds_per_second, *summary.ns_per_tick);
}

std::string heading(const Summary& summary) {
  return fmt::format("{} under {}: {}\n", summary.scene, summary.algorithm,
                     file::verdict_text(summary));
}

// Rule for the best value of a column; kNone: the column has no best value.
enum class Best : std::uint8_t {
  kNone,
  kSmallest,         // among the runs that did not diverge
  kLargest,          // among the runs that did not diverge
  kSmallestSettled,  // among the runs that settled: a wall that shakes is never the best
  kLargestSettled,
};

struct Column {
  std::string_view title;
  std::string_view unit;
  std::string (*text)(const Summary&);
  Best best = Best::kNone;
  std::optional<double> (*value)(const Summary&) = nullptr;  // compared for `best`
};

constexpr std::array<Column, 13> kColumns{
    {{"algorithm", "", [](const Summary& s) { return s.algorithm; }},
     {"verdict", "", [](const Summary& s) { return std::string(verdict_name(s.verdict)); }},
     {"tail p-p", "mm", [](const Summary& s) { return millimetres(s.tail_peak_to_peak_m); },
      Best::kSmallest, [](const Summary& s) { return s.tail_peak_to_peak_m; }},
     {"force mean", "N", [](const Summary& s) { return newtons(s.tail_force_mean_n); }},
     {"std", "N", [](const Summary& s) { return newtons(s.tail_force_std_n); },
      Best::kSmallestSettled, [](const Summary& s) { return s.tail_force_std_n; }},
     {"stiffness", "kN/m",
      [](const Summary& s) { return table::kilonewtons_per_metre(s.displayed_stiffness_n_per_m); },
      Best::kLargestSettled, [](const Summary& s) { return s.displayed_stiffness_n_per_m; }},
     {"max pen.", "mm", [](const Summary& s) { return millimetres(s.max_penetration_m); },
      Best::kSmallestSettled, [](const Summary& s) { return s.max_penetration_m; }},
     {"contacts", "", [](const Summary& s) { return fmt::format("{}", s.contacts); }},
     {"E observer", "mJ", [](const Summary& s) { return millijoules(s.energy_cv_j); }},
     {"E exchanged", "mJ", [](const Summary& s) { return millijoules(s.energy_scv_j); }},
     {"margin", "mJ", [](const Summary& s) { return millijoules(s.passivity_margin_j); },
      Best::kLargest, [](const Summary& s) { return s.passivity_margin_j; }},
     {"chatter", "N", [](const Summary& s) { return newtons(s.chatter_n); }},
     {"given", "mW",
      [](const Summary& s) { return file::fixed(s.given_w, kMilliwattsPerWatt, 2); }}}};
constexpr std::string_view kBestLegend =
    "* best of its column, before rounding: smallest tail p-p and largest margin of what did not "
    "diverge;\n"
    "  smallest std, largest stiffness and smallest max pen. of what settled\n";
constexpr std::size_t kHeadRows = 2;     // titles and units
constexpr std::size_t kTextColumns = 2;  // left-aligned; the rest are numbers

std::string_view tail_label(const Summary& s) {
  return s.verdict_note ? "whole run" : "last second";
}

std::string tail_text(const Summary& s) {
  if (!s.tail_peak_to_peak_m) return "not reached";
  return fmt::format("{} mm peak to peak, force {} +/- {} N", millimetres(s.tail_peak_to_peak_m),
                     newtons(s.tail_force_mean_n), newtons(s.tail_force_std_n));
}

std::string chatter_text(const Summary& s) {
  if (!s.chatter_n) return "not judged";
  std::string text = fmt::format("{} N, swing {} mm", newtons(s.chatter_n), millimetres(s.swing_m));
  if (s.shake_m_per_s2) text += fmt::format(", shake {:.2f} m/s²", *s.shake_m_per_s2);
  return text;
}

std::string given_text(const Summary& s) {
  if (!s.given_w) return "-";
  return fmt::format("{} mJ, {} mW in contact", millijoules(s.given_j),
                     file::fixed(s.given_w, kMilliwattsPerWatt, 2));
}

std::string contact_text(const Summary& s) {
  if (s.contacts == 0) return "no contact";
  return fmt::format(
      "{} contact{}, at most {} mm deep, peak force {} N, {} ticks at the force limit", s.contacts,
      s.contacts == 1 ? "" : "s", millimetres(s.max_penetration_m), newtons(s.peak_force_n),
      s.saturated_ticks);
}

std::string balance_text(const Summary& s) {
  if (!s.energy_balance_relative) return "-";
  const double turned_j =
      turnover_j(*s.true_hand_work_j, *s.true_actuator_work_j, *s.true_dissipation_j, *s.kinetic_j);
  return fmt::format("{:.1e} J ({:.1e} of {:.3g} J turned over)", *s.energy_balance_error_j,
                     *s.energy_balance_relative, turned_j);
}

std::string axis_lines(const Summary& s) {
  return summary_line(tail_label(s), tail_text(s)) +
         summary_line("displayed stiffness",
                      table::kilonewtons_per_metre(s.displayed_stiffness_n_per_m) + " kN/m") +
         summary_line("wall", contact_text(s)) + summary_line("chatter", chatter_text(s)) +
         summary_line("given to the hand", given_text(s)) +
         summary_line("energy observed",
                      fmt::format("{} mJ (Eq. 6), minimum {} mJ", millijoules(s.energy_cv_j),
                                  millijoules(s.min_energy_cv_j))) +
         summary_line("energy of the hold",
                      fmt::format("{} mJ (Eq. 9), budget {} mJ", millijoules(s.energy_hold_j),
                                  millijoules(s.energy_budget_j))) +
         summary_line("energy exchanged",
                      fmt::format("{} mJ (Eq. 10), minimum {} mJ", millijoules(s.energy_scv_j),
                                  millijoules(s.min_energy_scv_j))) +
         summary_line("true work", fmt::format("hand {} mJ, actuator {} mJ, dissipated {} mJ",
                                               millijoules(s.true_hand_work_j),
                                               millijoules(s.true_actuator_work_j),
                                               millijoules(s.true_dissipation_j))) +
         summary_line("energy balance error", balance_text(s)) +
         summary_line("passivity margin", millijoules(s.passivity_margin_j) + " mJ");
}

// A line of the comparison.
struct Row {
  Summary summary;   // of one axis
  std::size_t axis;  // rows of one axis are compared with each other
  bool diverged;     // true if any axis diverged: all metrics are those of a shorter run
};

std::vector<Row> comparison_rows(const std::vector<RunSummary>& runs) {
  std::vector<Row> rows;
  for (const RunSummary& run : runs) {
    const bool diverged = std::ranges::count(run, Verdict::kDiverged, &Summary::verdict) > 0;
    for (std::size_t axis = 0; axis < run.size(); ++axis) {
      rows.push_back({run[axis], axis, diverged});
      if (axis > 0) rows.back().summary.algorithm = "  axis y";
    }
  }
  return rows;
}

// The value of a row that the best of a column is chosen by, smaller is better; nullopt: the row
// does not take part.
std::optional<double> entry(const Column& column, const Row& row) {
  if (column.best == Best::kNone || row.diverged) return std::nullopt;
  const bool of_settled =
      column.best == Best::kSmallestSettled || column.best == Best::kLargestSettled;
  if (of_settled && !is_good(row.summary.verdict)) return std::nullopt;
  const std::optional<double> value = column.value(row.summary);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  const bool largest = column.best == Best::kLargest || column.best == Best::kLargestSettled;
  return largest ? -*value : *value;
}

bool is_best(const Column& column, const Row& row, const std::vector<Row>& rows) {
  const std::optional<double> own = entry(column, row);
  if (!own) return false;
  return std::ranges::none_of(rows, [&](const Row& other) {
    const std::optional<double> value = entry(column, other);
    return other.axis == row.axis && value && *value < *own;
  });
}

// The cells of a column below its title and unit. If any of them has a mark, the others get a space
// in its place, so that the digits stay aligned.
std::vector<std::string> column_cells(const Column& column, const std::vector<Row>& rows,
                                      bool marks) {
  std::vector<std::string> cells{std::string(column.title), std::string(column.unit)};
  for (const Row& row : rows) cells.push_back(column.text(row.summary));
  const auto best = [&](const Row& row) { return is_best(column, row, rows); };
  if (!marks || std::ranges::none_of(rows, best)) return cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] += i >= kHeadRows && best(rows[i - kHeadRows]) ? '*' : ' ';
  }
  return cells;
}

}  // namespace

std::string summary_line(std::string_view label, std::string_view text) {
  return fmt::format("  {:<{}}{}\n", label, kLabelWidth, text);
}

bool hand_moves_in_tail(const Scene& scene, const RunSummary& run, double end_s) {
  const bool of_a_device = !run.front().true_hand_work_j;  // held by a person
  if (of_a_device || run.front().verdict == Verdict::kDiverged) return false;
  const auto end_tick = static_cast<std::uint64_t>(std::llround(end_s * scene.sampling.rate_hz));
  const std::uint64_t from_tick = tail_begin_tick(end_tick, scene.sampling.rate_hz);
  for (std::size_t axis = 0; axis < scene.axes.size(); ++axis) {
    const auto& hand = scene.axes[axis].hand;
    const bool has_script = hand && !hand->follows_mouse;
    if (has_script && !hand_rests(axis_scene(scene, axis), from_tick, end_tick)) return true;
  }
  return false;
}

std::string summary_lines(const RunSummary& run, const Circumstances& circumstances) {
  const Summary& s = run.front();
  // A run on a device has no true hand work and is not simulated.
  const char* label = s.true_hand_work_j ? "simulated" : "run";
  std::string text = heading(s) +
                     summary_line(label, fmt::format("{:.6g} s, {} ticks{}", s.duration_s, s.ticks,
                                                     speed_text(s))) +
                     axis_lines(s);
  for (const Summary& y : std::span(run).subspan(1)) {
    text += fmt::format("axis y: {}\n", file::verdict_text(y)) + axis_lines(y);
  }
  if (!circumstances.realtime_status.empty()) {
    text += summary_line("real time", circumstances.realtime_status);
  }
  if (circumstances.hand_moves_in_tail) text += summary_line("note", kHandMoves);
  return text;
}

std::string comparison_table(const std::vector<RunSummary>& runs) {
  const std::vector<Row> rows = comparison_rows(runs);
  const bool marks = runs.size() > 1;
  std::vector<Column> columns(kColumns.begin(), kColumns.end());
  const std::optional<std::uint64_t> hands = runs.front().front().searched_hands;
  const std::string hands_title = table::hand_column_title(hands.value_or(0));
  if (hands) columns.push_back({hands_title, table::kHandColumnUnit, table::hand_column_text});
  std::vector<std::vector<std::string>> cells(rows.size() + kHeadRows);
  for (const Column& column : columns) {
    const std::vector<std::string> texts = column_cells(column, rows, marks);
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i].push_back(texts[i]);
  }
  std::vector<table::Align> aligns(columns.size(), table::Align::kRight);
  std::fill_n(aligns.begin(), kTextColumns, table::Align::kLeft);
  std::string table = table::aligned(cells, aligns);
  if (table.find('*') != std::string::npos) table += kBestLegend;
  if (hands) table += table::hand_column_note(*hands);
  return table;
}

}  // namespace hapticwall::command
