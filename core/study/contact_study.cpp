#include "core/study/contact_study.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/simulation/simulate.h"

namespace hapticwall {
namespace {

constexpr std::string_view kFirstStiffness = "wall[0].stiffness_n_per_m";
constexpr double kRiseFrom = 0.1;
constexpr double kRiseTo = 0.9;
constexpr double kSearchShare = 0.9;  // of the progress

Scene scene_of(const ContactStudyPlan& plan, std::size_t algorithm) {
  Scene scene = plan.scene;
  scene.axes.resize(1);
  scene.algorithm.index = algorithm;
  return scene;
}

// False if stopped.
bool find_limits(const ContactStudyPlan& plan, const ContactStudyOptions& options,
                 std::vector<ContactMetrics>& rows) {
  BoundaryOptions search;
  search.should_stop = options.should_stop;
  if (options.progress) {
    search.progress = [&](double fraction) { options.progress(kSearchShare * fraction); };
  }
  std::vector<Boundary> limits = find_boundaries(
      {scene_of(plan, 0), plan.algorithms, std::nullopt, plan.stiffnesses(), plan.tolerance},
      search);
  if (limits.empty()) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].limits = std::move(limits[i]);
  return true;
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
bool look_at_contact(const Scene& scene, const ContactStudyOptions& study,
                     ContactMetrics& metrics) {
  SimulationOptions options;
  options.should_stop = study.should_stop;
  SimulationResult result = simulate(scene, options);
  if (result.stopped_early) return false;
  metrics.summary = std::move(result.summary);
  FirstContact contact(scene.sampling.period_s());
  ForceRise rise(metrics.summary.tail_force_mean_n.value_or(0.0));
  double deepest_m = result.final_state.truth.position_m;
  options.on_sample = [&](const Sample& sample) {
    contact.add(sample);
    rise.add(sample);
    deepest_m = std::max(deepest_m, sample.truth.position_m);
  };
  if (simulate(scene, options).stopped_early) return false;
  metrics.approach_speed_m_per_s = contact.approach_speed_m_per_s();
  metrics.rate_hardness_n_per_m = contact.rate_hardness_n_per_m();
  metrics.rise_kind = contact.kind();
  if (metrics.summary.verdict == Verdict::kSettled) metrics.rise_time_s = rise.time_s();
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
  if (!find_limits(plan, options, rows)) return {};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!look_at_contact(scene_of(plan, plan.algorithms[i]), options, rows[i])) return {};
    const double done = static_cast<double>(i + 1) / static_cast<double>(rows.size());
    if (options.progress) options.progress(kSearchShare + (1.0 - kSearchShare) * done);
  }
  return rows;
}

}  // namespace hapticwall
