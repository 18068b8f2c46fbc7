// What the plots panel remembers from frame to frame.
#pragma once

#include <array>
#include <future>
#include <optional>
#include <vector>

#include "app/ui/export.h"
#include "app/ui/extra_traces.h"
#include "app/ui/phase_plot.h"
#include "app/ui/plot.h"
#include "app/ui/plot_cursors.h"
#include "app/ui/plot_trigger.h"

namespace hapticwall::ui {

// Lengths of the time window, in s.
inline constexpr std::array kTimeWindowsS{0.05, 0.1, 0.2,  0.5,  1.0,   2.0,   4.0,
                                          6.0,  8.0, 10.0, 60.0, 600.0, 3600.0};

struct PlotsState {
  // Worth keeping from one start of the program to the next.
  struct Persisted {
    ChosenLines lines = usual_lines();
    TriggerSettings trigger;
    PhaseSettings phase;
    bool show_bounds = true;
  } persisted;

  // Lasts as long as the window.
  struct Transient {
    AllPlotAxes axes;
    Trigger trigger;
    bool was_following = true;
    Cursors cursors;
    PhaseView phase;
    std::vector<PixelColumn> columns;
    std::vector<ExtraTrace> extra_traces;  // see replace_extra_traces()
    ExportJob exporting;
  } transient;
};

}  // namespace hapticwall::ui
