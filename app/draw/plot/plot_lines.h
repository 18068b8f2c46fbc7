// The signals, their plots and their units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "app/draw/plot/dashes.h"
#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"

namespace hapticwall::draw {

enum class PlotId : std::uint8_t { kPosition, kForce, kStiffness, kPassivity };
inline constexpr std::size_t kPlotCount = 4;

inline constexpr std::array kAllPlots{PlotId::kPosition, PlotId::kForce, PlotId::kStiffness,
                                      PlotId::kPassivity};

// A set of lines, one bit per Quantity.
using LineSet = std::uint32_t;
using HiddenLines = LineSet;
static_assert(kQuantityCount <= 32);
[[nodiscard]] constexpr LineSet line_bit(Quantity quantity) {
  return LineSet{1} << quantity.index();
}

enum class LineKind : std::uint8_t {
  kUsual,      // shown by default
  kExtra,      // shown on request
  kTruth,      // as kUsual, and known to a simulator only
  kSimulator,  // as kExtra, and known to a simulator only
};

// An axis of values, on the left or on the right.
struct ValueScale {
  const char* unit = "";
  double scale = 0.0;          // of SI values into `unit`
  double smallest_span = 1.0;  // of the axis, in `unit`
};

struct PlotLine {
  Quantity quantity = &Sample::position_m;
  const char* name = "";
  const char* meaning = "";
  Tone tone = Tone::kText;
  LineKind kind = LineKind::kUsual;
  Dash dash = Dash::kSolid;
  bool on_right = false;  // of the second axis
  bool wish = false;      // not what happens: the axis follows it only if it stands alone
  // Of a truth: the signal that measures it; while that is drawn, it has the band for both.
  std::optional<Quantity> measured_as = std::nullopt;

  [[nodiscard]] bool is_truth() const {
    return kind == LineKind::kTruth || kind == LineKind::kSimulator;
  }
};

struct PlotDescription {
  PlotId id = PlotId::kPosition;
  const char* title = "";
  ValueScale left;
  ValueScale left_large;  // in the place of `left` from 1000 of its units; no scale: none
  ValueScale right;       // of the lines with `on_right`
  std::span<const PlotLine> lines;

  [[nodiscard]] const ValueScale& scale_of(const PlotLine& line) const {
    return line.on_right ? right : left;
  }
};

[[nodiscard]] const PlotDescription& plot_description(PlotId id);

// By PlotId.
using ChosenLines = std::array<LineSet, kPlotCount>;
[[nodiscard]] const ChosenLines& usual_lines();

}  // namespace hapticwall::draw
