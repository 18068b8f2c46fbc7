// State of the plots.
#pragma once

#include <cstdint>
#include <vector>

#include "app/draw/plot/extra_traces.h"
#include "app/draw/plot/phase_plot.h"
#include "app/draw/plot/plot.h"
#include "app/draw/plot/plot_cursors.h"
#include "app/draw/plot/plot_trigger.h"
#include "app/draw/plot/spectrum_plot.h"
#include "app/ui/state/export.h"

namespace hapticwall::ui {

// Plots that are shown: two, all, or the panels (a), (b), (c) of the paper's figures.
enum class PlotArrangement : std::uint8_t { kTwo, kAll, kFigure4, kFigure5And6 };

struct PlotsState {
  // Stored in the settings file.
  struct Persisted {
    PlotArrangement arrangement = PlotArrangement::kTwo;
    draw::ChosenLines lines = draw::usual_lines();
    draw::HiddenLines hidden_lines = 0;
    draw::TriggerSettings trigger;
    draw::PhaseSettings phase;
    draw::SpectrumSettings spectrum;
    bool show_bounds = true;
    bool show_counts = false;  // the encoder's counts beside the true position of a simulator
  } persisted;

  // Lives as long as the window.
  struct Transient {
    draw::AllPlotAxes axes;
    draw::Trigger trigger;
    bool was_following = true;
    draw::Cursors cursors;
    draw::PhaseView phase;
    draw::SpectrumView spectrum;
    draw::PlotScratch scratch;
    std::vector<draw::ExtraTrace> extra_traces;  // see replace_extra_traces()
    ExportJob exporting;
  } transient;
};

}  // namespace hapticwall::ui
