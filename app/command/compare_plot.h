// compare --plot: the samples of all runs, and the figure of them.
#pragma once

#include <string>
#include <vector>

#include "app/command/output_file.h"
#include "app/ui/comparison_figure.h"
#include "core/result.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall::command {

class ComparisonPlot {
 public:
  // Opens the file; nothing where `path` is empty. More runs or ticks than a figure shows are usage
  // errors.
  [[nodiscard]] Failure open(const std::string& path, const Scene& scene, std::size_t runs);
  [[nodiscard]] bool is_open() const { return file_.is_open(); }

  // Run by run: what comes between is of the run that began last.
  void begin_run();
  void take(const Sample& sample);

  // Draws the runs in the order of `order`, and gives the file its name; nothing where none is
  // open. `summaries`: one a run, as they were begun.
  [[nodiscard]] Failure finish(const Scene& scene, const std::vector<Summary>& summaries,
                               const std::vector<std::size_t>& order);

 private:
  OutputFile file_;
  std::uint64_t ticks_ = 0;  // of a run, at most
  std::vector<ui::SampleHistory> histories_;
};

}  // namespace hapticwall::command
