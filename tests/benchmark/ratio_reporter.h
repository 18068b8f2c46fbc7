// Says what the measurements mean: nanoseconds a tick, and the ratio to the bare loop of the same
// run, with and without the set-up of a scene.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

namespace hapticwall::benchmark_rows {

class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  // The median of a benchmark's repetitions.
  struct Row {
    std::string name;
    std::int64_t family;
    double total_ns;
    double ticks;
    double events;
    double simulated_s;  // above 0: the row is told by the wall's clock
    double real_s;
  };

  [[nodiscard]] const Row* find(const std::string& name) const;
  void print_row(const Row& row, double bare_ns) const;
  void print_events(const Row& row) const;
  void print_kernel(const Row& row) const;
  static void print_map(const Row& row, double bare_ns);

  std::vector<Row> rows_;
  bool failed_ = false;
};

}  // namespace hapticwall::benchmark_rows
