// The force over the penetration: a loop, whose area is energy.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "app/ui/plot.h"
#include "app/ui/plot_trigger.h"
#include "app/ui/sample_history.h"
#include "app/ui/theme.h"
#include "core/scene.h"

namespace hapticwall::ui {

struct PhaseSettings {
  bool shown = false;
  bool last_contact = false;   // of the visible range the newest contact alone, else all
  bool true_position = false;  // as the simulator knows it, else as the encoder tells it
};

// Points in SI units: penetration in m, force in N.
struct PhasePath {
  std::vector<double> penetration_m;
  std::vector<double> force_n;

  void clear();
  void add(double x_m, double y_n);
};

// The path of a range: the force of a tick is held until the next one, so the path goes across at
// constant force and then up or down, and its area is the energy that the actuator exchanged.
// `path` is overwritten.
void trace_phase(const SampleHistory& history, IndexRange range, bool true_position,
                 PhasePath& path);

// ∫ F dp along the path, in J. Positive: the wall took energy; negative: it gave some. For a closed
// path this is the area that it encloses.
[[nodiscard]] double phase_energy_j(const PhasePath& path);

// More samples than these are not drawn: of a longer range the newest.
inline constexpr std::size_t kMostPhaseSamples = 10'000;

// What of the window is traced.
[[nodiscard]] IndexRange phase_range(const SampleHistory& history, const PhaseSettings& settings,
                                     TimeWindow window);

// A straight piece of the path on the screen: along a row of pixels, or along a column.
struct PixelSpan {
  int line = 0;  // the row's y, or the column's x
  int from = 0;
  int to = 0;

  friend bool operator==(const PixelSpan&, const PixelSpan&) = default;
};

// Sorts the spans and joins those of the same line that touch: what is drawn over and over is drawn
// once.
void join_spans(std::vector<PixelSpan>& spans);

// What the plane remembers from frame to frame.
struct PhaseView {
  ValueAxis penetration;  // mm
  ValueAxis force;        // N
  PhasePath path;
  std::vector<PixelSpan> rows;
  std::vector<PixelSpan> columns;
  double energy_j = 0.0;    // of what is drawn
  std::size_t samples = 0;  // of what is drawn
};

struct PhaseSurface {
  const Theme* theme = nullptr;
  const SampleHistory* history = nullptr;
  std::span<const WallSettings> walls;
  TimeWindow window;
  bool simulated = true;
  bool interactive = true;
  float line_weight = kLineWeight;
  std::function<void(std::string_view)> remember;  // may be empty
};

// Draws heading, controls and the plane into `size`.
PlotArea draw_phase_plot(const PhaseSurface& surface, PhaseSettings& settings, PhaseView& view,
                         ImVec2 size);

}  // namespace hapticwall::ui
