// State of an identification, which the page starts and the arming strip shows.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/draw/figure/identify_figure.h"
#include "app/session/identify_experiment.h"
#include "app/session/window_options.h"
#include "app/table/identify_report.h"
#include "app/ui/computed/background.h"

namespace hapticwall::ui {

struct Identified {
  table::IdentifiedBy by;
  identify::Identification found;
  file::DeviceDescription device;  // with the numbers, if the model fits
  std::vector<draw::FigurePanel> panels;
};

// `hapticwall identify` in the window. Lives as long as the window.
struct IdentifyState {
  session::IdentifyChoice choice;
  std::string device = "sim";                               // as in session::WindowOptions
  std::optional<file::DeviceDescription> description{};     // see WindowOptions::description
  bool wanted = false;                                      // its session begins after this frame
  std::shared_ptr<session::IdentifyExperiment> experiment;  // of the session; null: none
  Background<Identified> fit;
  std::optional<Identified> result;
  std::string problem;  // why there is no result
  std::string name;     // of the device file; empty: that of the device
};

}  // namespace hapticwall::ui
