// The force over the penetration: a loop, whose area is energy.
#pragma once

#include <vector>

#include "app/draw/plot/plot.h"
#include "app/draw/plot/plot_trigger.h"
#include "app/draw/plot/sample_history.h"
#include "core/scene.h"

namespace hapticwall::draw {

struct PhaseSettings {
  bool shown = false;
  bool last_contact = false;   // only the newest contact of the visible range
  bool true_position = false;  // true: from the simulator; false: from the encoder
};

// Points in SI units: penetration in m, force in N.
struct PhasePath {
  std::vector<double> penetration_m;
  std::vector<double> force_n;

  void clear();
  void add(double at_penetration_m, double at_force_n);
};

// The path of a range. The force of a tick is held until the next one: the path goes across at
// constant force, then up or down. Its area is the energy that the actuator exchanged.
// Overwrites `path`.
void trace_phase(const SampleHistory& history, IndexRange range, bool true_position,
                 PhasePath& path);

// ∫ F dp along the path, in J. Positive: the wall took energy; negative: it gave energy. A closed
// path encloses this area.
[[nodiscard]] double phase_energy_j(const PhasePath& path);

// Max samples that are drawn: of a longer range only the newest.
inline constexpr std::size_t kMaxPhaseSamples = 10'000;

// The part of the window that is traced.
[[nodiscard]] IndexRange phase_range(const SampleHistory& history, const PhaseSettings& settings,
                                     TimeWindow window);

// A straight piece of the path on the screen: along a row of pixels, or along a column.
struct PixelSpan {
  int line = 0;  // the row's y, or the column's x
  int from = 0;
  int to = 0;

  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

// Sorts the spans and joins those of a line that touch, so that each pixel is drawn
// once.
void join_spans(std::vector<PixelSpan>& spans);

// The state of the plane between frames.
struct PhaseView {
  ValueAxis penetration;  // mm
  ValueAxis force;        // N
  PhasePath path;
  std::vector<PixelSpan> rows;
  std::vector<PixelSpan> columns;
  double energy_j = 0.0;    // energy of the drawn path
  std::size_t samples = 0;  // number of samples of the drawn path
};

// Draws heading, controls and the plane into `size`.
PlotArea draw_phase_plot(const PlotSurface& surface, PhaseSettings& settings, PhaseView& view,
                         ImVec2 size);

}  // namespace hapticwall::draw
