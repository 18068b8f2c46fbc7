// The signals, their plots and their units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/draw/axis/dashes.h"
#include "app/draw/axis/ticks.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

enum class PlotId : std::uint8_t { kPosition, kForce, kStiffness, kPassivity };
inline constexpr std::size_t kPlotCount = 4;

inline constexpr std::array kAllPlots{PlotId::kPosition, PlotId::kForce, PlotId::kStiffness,
                                      PlotId::kPassivity};

// A set of lines, one bit per Quantity.
using LineSet = std::uint64_t;
using HiddenLines = LineSet;
static_assert(kQuantityCount <= 64);
[[nodiscard]] constexpr LineSet line_bit(Quantity quantity) {
  return LineSet{1} << quantity.index();
}

enum class LineKind : std::uint8_t {
  kUsual,      // shown by default
  kExtra,      // shown on request
  kTruth,      // like kUsual, but known to a simulator only
  kSimulator,  // like kExtra, but known to a simulator only
};

// A plot has up to three value axes. The right axis shows the rate of change of the left one; the
// outermost axis shows the rate of change of the right one.
enum class Side : std::uint8_t { kLeft, kRight, kFarRight };
inline constexpr std::array kRightSides{Side::kRight, Side::kFarRight};

// An axis of values.
struct ValueScale {
  const char* unit = "";
  double scale = 0.0;          // factor from SI values to `unit`
  double smallest_span = 1.0;  // smallest span of the axis, in `unit`
  double knee = 0.0;           // in `unit`, of a symlog axis (ticks.h); 0: linear

  // The place of an SI value on the axis.
  [[nodiscard]] double on_axis(double value) const {
    return knee > 0.0 ? to_symlog(value * scale, knee) : value * scale;
  }
};

struct PlotLine {
  Quantity quantity = &Sample::position_m;
  const char* name = "";
  const char* meaning = "";
  Tone tone = Tone::kText;
  LineKind kind = LineKind::kUsual;
  Dash dash = Dash::kSolid;
  Side side = Side::kLeft;
  bool wish = false;  // a desired value: the axis follows it only if it stands alone
  // For a true value: the signal that measures it. While that signal is drawn, it has the band for
  // both.
  std::optional<Quantity> measured_as = std::nullopt;

  [[nodiscard]] bool is_truth() const {
    return kind == LineKind::kTruth || kind == LineKind::kSimulator;
  }
};

struct PlotDescription {
  PlotId id = PlotId::kPosition;
  const char* title = "";
  const char* quantity = "";  // name and symbol, for the title of a printed axis
  ValueScale left;
  ValueScale left_large;  // replaces `left` from 1000 of its units; no scale: none
  ValueScale right;
  ValueScale far_right;  // no scale: none
  std::span<const PlotLine> lines;

  [[nodiscard]] const ValueScale& scale_of(Side side) const {
    return side == Side::kLeft ? left : side == Side::kRight ? right : far_right;
  }
  [[nodiscard]] const ValueScale& scale_of(const PlotLine& line) const {
    return scale_of(line.side);
  }
};

// The plots with the lines that are always there.
[[nodiscard]] const PlotDescription& plot_description(PlotId id);

// A signal and its plot.
struct PlottedLine {
  const PlotDescription* plot = nullptr;
  const PlotLine* line = nullptr;

  [[nodiscard]] const ValueScale& scale() const { return plot->scale_of(*line); }
};

// All plots with their lines: the built-in ones first, then the algorithms' signals, each in the
// plot that has its unit. A signal with another unit has no line.
class PlotTable {
 public:
  explicit PlotTable(const SignalNames& signals = {});
  PlotTable(const PlotTable&) = delete;
  PlotTable& operator=(const PlotTable&) = delete;

  [[nodiscard]] const PlotDescription& operator[](PlotId id) const {
    return plots_[static_cast<std::size_t>(id)];
  }
  // Nullopt for a place without a signal, and for a column that is not plotted.
  [[nodiscard]] std::optional<PlottedLine> find(Quantity quantity) const;
  [[nodiscard]] std::optional<PlottedLine> find(std::string_view name) const;

 private:
  template <typename Wanted>
  [[nodiscard]] std::optional<PlottedLine> find_line(Wanted&& wanted) const;
  void add(std::size_t place, std::string_view signal);

  std::array<PlotDescription, kPlotCount> plots_;
  std::array<std::vector<PlotLine>, kPlotCount> lines_;
  std::array<std::string, kMaxSignals> signals_;  // names of the algorithms' signals
  std::array<std::string, kMaxSignals> meanings_;
};
// Plots without the signals of algorithms.
[[nodiscard]] const PlotTable& usual_plots();

// Chosen lines of each plot, indexed by PlotId.
using ChosenLines = std::array<LineSet, kPlotCount>;
[[nodiscard]] const ChosenLines& usual_lines();
// The usual lines, and those of these signals.
[[nodiscard]] ChosenLines lines_with(const SignalNames& signals);

}  // namespace hapticwall::draw
