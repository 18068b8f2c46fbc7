#include "tests/benchmark/ratio_reporter.h"

#include <algorithm>
#include <cstdio>

#include "tests/benchmark/rows.h"

namespace hapticwall::benchmark_rows {
namespace {

// Google Benchmark has renamed this.
template <typename Run>
bool went_wrong(const Run& run) {
  if constexpr (requires { run.error_occurred; }) {
    return run.error_occurred;
  } else {
    return run.skipped != decltype(run.skipped){};
  }
}

template <typename Run>
double counter(const Run& run, const char* name) {
  const auto found = run.counters.find(name);
  return found == run.counters.end() ? 0.0 : static_cast<double>(found->second);
}

}  // namespace

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (went_wrong(run)) {
      failed_ = true;
      std::fprintf(stderr, "%s went wrong\n", run.benchmark_name().c_str());
      continue;
    }
    const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
    if (!median && run.repetitions > 1) continue;
    // Processor time: a shared machine does not count against a row.
    rows_.push_back({run.run_name.function_name, run.family_index, run.GetAdjustedCPUTime(),
                     counter(run, kTicksCounter), counter(run, kEventsCounter),
                     counter(run, kSimulatedCounter),
                     run.real_accumulated_time / static_cast<double>(run.iterations)});
  }
}

void RatioReporter::Finalize() {
  // Repetitions are interleaved at random; the table is not.
  std::sort(rows_.begin(), rows_.end(),
            [](const Row& a, const Row& b) { return a.family < b.family; });
  const Row* bare = find(kBareLoop);
  if (bare == nullptr) return;
  std::printf("%-46s %11s %9s %15s %14s\n", "", "ns per tick", "ratio", "without set-up",
              "set-up, ns");
  for (const Row& row : rows_) {
    if (row.name.ends_with(kSetUpSuffix) || row.name.ends_with(kWithoutSuffix)) continue;
    if (row.simulated_s > 0.0) continue;
    print_row(row, bare->total_ns / bare->ticks);
  }
  for (const Row& row : rows_) {
    if (row.events > 0.0) print_events(row);
    print_kernel(row);
    if (row.simulated_s > 0.0) print_map(row, bare->total_ns / bare->ticks);
  }
}

void RatioReporter::print_row(const Row& row, double bare_ns) const {
  const double tick_ns = row.total_ns / row.ticks;
  std::printf("%-46s %11.2f %8.2fx", row.name.c_str(), tick_ns, tick_ns / bare_ns);
  if (const Row* before = find(row.name + kSetUpSuffix)) {
    const double loop_ns = (row.total_ns - before->total_ns) / (row.ticks - before->ticks);
    // A set-up row has one tick per scene.
    std::printf(" %14.2fx %14.0f", loop_ns / bare_ns, before->total_ns / before->ticks);
  }
  std::printf("\n");
}

void RatioReporter::print_events(const Row& row) const {
  const Row* without = find(row.name + kWithoutSuffix);
  if (without == nullptr) return;
  std::printf("%s: %.0f ns an event (%.0f events in %.0f ticks)\n", row.name.c_str(),
              (row.total_ns - without->total_ns) / row.events, row.events, row.ticks);
}

// Prints the ratio without the set-up, which is that of a matrix for each level of the tick.
void RatioReporter::print_kernel(const Row& row) const {
  const Row* kernel = find(row.name + kKernelSuffix);
  if (kernel == nullptr) return;
  const Row* before = find(row.name + kSetUpSuffix);
  const double loop_ns = row.total_ns - (before != nullptr ? before->total_ns : 0.0);
  std::printf("%s: %.2fx the friction kernel (%.2f ns a tick)\n", row.name.c_str(),
              loop_ns / kernel->total_ns, kernel->total_ns / kernel->ticks);
}

void RatioReporter::print_map(const Row& row, double bare_ns) {
  constexpr double kNanoseconds = 1e9;
  std::printf("%s: %.2f s on all cores, %.0f simulated seconds per second, %.2fx the bare loop\n",
              row.name.c_str(), row.real_s, row.simulated_s / row.real_s,
              row.real_s * kNanoseconds / row.ticks / bare_ns);
}

const RatioReporter::Row* RatioReporter::find(const std::string& name) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
  return found == rows_.end() ? nullptr : &*found;
}

}  // namespace hapticwall::benchmark_rows
