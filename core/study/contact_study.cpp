#include "core/study/contact_study.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "core/batch/batch_simulator.h"
#include "core/simulation/simulate.h"

namespace hapticwall {
namespace {

constexpr std::string_view kFirstStiffness = "wall[0].stiffness_n_per_m";
constexpr double kRiseFrom = 0.1;
constexpr double kRiseTo = 0.9;
constexpr std::size_t kRunsOfScene = 2;
constexpr double kRangesRefined = 2.0;

Scene scene_of(const ContactStudyPlan& plan, std::size_t algorithm) {
  Scene scene = plan.scene;
  scene.axes.resize(1);
  scene.algorithm.index = algorithm;
  return scene;
}

class StudyWork {
 public:
  StudyWork(const ContactStudyPlan& plan, const ContactStudyOptions& options) : options_(options) {
    const double steps = std::ceil(std::log2(1.0 / plan.tolerance));
    total_ = static_cast<double>(plan.algorithms.size()) *
             (static_cast<double>(plan.count + kRunsOfScene) + kRangesRefined * steps);
  }
  void show(std::size_t done_of_batch) const {
    if (!options_.progress) return;
    options_.progress(std::min(1.0, (done_ + static_cast<double>(done_of_batch)) / total_));
  }
  void add(std::size_t runs) {
    done_ += static_cast<double>(runs);
    show(0);
  }
  [[nodiscard]] const ContactStudyOptions& options() const { return options_; }

 private:
  const ContactStudyOptions& options_;
  double total_ = 0.0;
  double done_ = 0.0;
};

// Empty if stopped.
std::vector<Summary> run_all(const std::vector<Scene>& scenes, StudyWork& work) {
  std::vector<Summary> summaries =
      simulate_all(scenes, {.should_stop = work.options().should_stop,
                            .progress = [&](std::size_t done, std::size_t) { work.show(done); }});
  if (!summaries.empty()) work.add(scenes.size());
  return summaries;
}

using Stiffest = std::optional<LargestStiffness> ContactMetrics::*;

// Bisection of the upper end of a settled range.
struct StiffnessSearch {
  std::size_t row = 0;  // in ContactStudyPlan::algorithms
  Stiffest stiffest = nullptr;
  double settled = 0.0;
  double unsettled = 0.0;
};

bool is_settled(const Summary& summary) { return summary.verdict == Verdict::kSettled; }

bool take_stiffer(const Summary& run, double wall_n_per_m,
                  std::optional<LargestStiffness>& stiffest) {
  const std::optional<double> displayed = run.displayed_stiffness_n_per_m;
  if (!is_settled(run) || !displayed) return false;
  if (stiffest && *displayed <= stiffest->displayed_n_per_m) return false;
  stiffest = {*displayed, wall_n_per_m, run.tail_force_std_n.value_or(0.0),
              stiffest && stiffest->open_ended};
  return true;
}

// The scan under one algorithm.
struct Scan {
  const MapAxis& axis;
  std::span<const Summary> runs;

  // Index of the first run from `begin` on that does not settle.
  [[nodiscard]] std::size_t settled_end(std::size_t begin) const {
    while (begin < runs.size() && is_settled(runs[begin])) ++begin;
    return begin;
  }
};

// Marks the settled range that ends at `end` as open-ended, or adds its refinement to `open`.
void close_range(const Scan& scan, std::size_t end, StiffnessSearch search, ContactMetrics& metrics,
                 std::vector<StiffnessSearch>& open) {
  std::optional<LargestStiffness>& stiffest = metrics.*search.stiffest;
  if (!stiffest) return;
  stiffest->open_ended = end == scan.runs.size();
  if (stiffest->open_ended) return;
  search.settled = scan.axis.value(end - 1);
  search.unsettled = scan.axis.value(end);
  open.push_back(search);
}

// Appends the refinements that are left to `open`.
void take_scan(const Scan& scan, std::size_t row, ContactMetrics& metrics,
               std::vector<StiffnessSearch>& open) {
  std::size_t best = 0;
  const std::size_t first_end = scan.settled_end(0);
  for (std::size_t i = 0; i < scan.runs.size(); ++i) {
    const Summary& run = scan.runs[i];
    if (is_settled(run) && (i == 0 || !is_settled(scan.runs[i - 1]))) ++metrics.settled_ranges;
    if (take_stiffer(run, scan.axis.value(i), metrics.stiffest)) best = i;
    if (i < first_end) take_stiffer(run, scan.axis.value(i), metrics.stiffest_unbroken);
  }
  close_range(scan, scan.settled_end(best), {row, &ContactMetrics::stiffest}, metrics, open);
  close_range(scan, first_end, {row, &ContactMetrics::stiffest_unbroken}, metrics, open);
}

bool is_open(const ContactStudyPlan& plan, const StiffnessSearch& search) {
  const double middle = std::sqrt(search.settled) * std::sqrt(search.unsettled);
  return search.unsettled - search.settled > plan.tolerance * search.unsettled &&
         middle > search.settled && middle < search.unsettled;
}

// False if stopped.
bool refine(const ContactStudyPlan& plan, std::vector<StiffnessSearch> open, StudyWork& work,
            std::vector<ContactMetrics>& rows) {
  const MapAxis axis = plan.stiffnesses();
  const auto closed = [&](const StiffnessSearch& search) { return !is_open(plan, search); };
  for (std::erase_if(open, closed); !open.empty(); std::erase_if(open, closed)) {
    std::vector<Scene> scenes;
    std::vector<double> middles;
    for (const StiffnessSearch& search : open) {
      middles.push_back(std::sqrt(search.settled) * std::sqrt(search.unsettled));
      scenes.push_back(scene_of(plan, plan.algorithms[search.row]));
      axis.number.set(scenes.back(), middles.back());
    }
    const std::vector<Summary> runs = run_all(scenes, work);
    if (runs.size() != open.size()) return false;
    for (std::size_t i = 0; i < open.size(); ++i) {
      take_stiffer(runs[i], middles[i], rows[open[i].row].*open[i].stiffest);
      (is_settled(runs[i]) ? open[i].settled : open[i].unsettled) = middles[i];
    }
  }
  return true;
}

// False if stopped.
bool find_stiffest(const ContactStudyPlan& plan, StudyWork& work,
                   std::vector<ContactMetrics>& rows) {
  const MapAxis axis = plan.stiffnesses();
  std::vector<Scene> scenes;
  for (const std::size_t algorithm : plan.algorithms) {
    for (std::size_t i = 0; i < axis.count; ++i) {
      scenes.push_back(scene_of(plan, algorithm));
      axis.number.set(scenes.back(), axis.value(i));
    }
  }
  const std::vector<Summary> scan = run_all(scenes, work);
  if (scan.size() != scenes.size()) return false;
  std::vector<StiffnessSearch> open;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    take_scan({axis, std::span(scan).subspan(row * axis.count, axis.count)}, row, rows[row], open);
  }
  return refine(plan, std::move(open), work, rows);
}

// Ticks at which the command first reaches shares of its final value.
class ForceRise {
 public:
  explicit ForceRise(double final_n) : final_n_(final_n) {}

  void add(const Sample& sample) {
    if (!from_s_ && sample.force_n >= kRiseFrom * final_n_) from_s_ = sample.time_s;
    if (!to_s_ && sample.force_n >= kRiseTo * final_n_) to_s_ = sample.time_s;
  }
  [[nodiscard]] std::optional<double> time_s() const {
    if (!(final_n_ > 0.0) || !from_s_ || !to_s_) return std::nullopt;
    return *to_s_ - *from_s_;
  }

 private:
  double final_n_;
  std::optional<double> from_s_;
  std::optional<double> to_s_;
};

// Runs the unchanged scene twice: the rise time of the second run needs the summary of the first.
// False if stopped.
bool look_at_contact(const Scene& scene, StudyWork& work, ContactMetrics& metrics) {
  SimulationOptions options;
  options.should_stop = work.options().should_stop;
  SimulationResult result = simulate(scene, options);
  if (result.stopped_early) return false;
  metrics.summary = std::move(result.summary);
  work.add(1);
  FirstContact contact(scene.sampling.period_s());
  ForceRise rise(metrics.summary.tail_force_mean_n.value_or(0.0));
  double deepest_m = result.final_state.truth.position_m;
  options.on_sample = [&](const Sample& sample) {
    contact.add(sample);
    rise.add(sample);
    deepest_m = std::max(deepest_m, sample.truth.position_m);
  };
  if (simulate(scene, options).stopped_early) return false;
  work.add(1);
  metrics.approach_speed_m_per_s = contact.approach_speed_m_per_s();
  metrics.rate_hardness_n_per_m = contact.rate_hardness_n_per_m();
  metrics.rise_kind = contact.kind();
  if (is_settled(metrics.summary)) metrics.rise_time_s = rise.time_s();
  const double penetration_m = deepest_m - scene.x().walls.front().position_m;
  if (penetration_m > 0.0) metrics.peak_penetration_m = penetration_m;
  metrics.energy_to_hand_j = std::max(0.0, -metrics.summary.passivity_margin_j.value_or(0.0));
  return true;
}

}  // namespace

MapAxis ContactStudyPlan::stiffnesses() const {
  return {find_scene_number(scene, kFirstStiffness).value(), low_n_per_m, high_n_per_m, count,
          true};
}

std::optional<SceneProblem> validate(const ContactStudyPlan& plan) {
  if (plan.scene.x().walls.empty()) {
    return SceneProblem{"wall", "the study varies the stiffness of a wall, and there is none"};
  }
  const MapAxis axis = plan.stiffnesses();
  for (const std::size_t algorithm : plan.algorithms) {
    Scene scene = scene_of(plan, algorithm);
    if (auto problem = validate(scene)) return problem;
    for (const std::size_t end : {std::size_t{0}, axis.count - 1}) {
      axis.number.set(scene, axis.value(end));
      if (auto problem = validate(scene)) return problem;
    }
  }
  return std::nullopt;
}

std::vector<ContactMetrics> study_contact(const ContactStudyPlan& plan,
                                          const ContactStudyOptions& options) {
  std::vector<ContactMetrics> rows(plan.algorithms.size());
  StudyWork work(plan, options);
  if (!find_stiffest(plan, work, rows)) return {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!look_at_contact(scene_of(plan, plan.algorithms[i]), work, rows[i])) return {};
  }
  return rows;
}

}  // namespace hapticwall
