#include "core/study/contact_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"

namespace hapticwall {
namespace {

constexpr std::string_view kFirstStiffness = "wall[0].stiffness_n_per_m";
constexpr double kRiseFrom = 0.1;
constexpr double kRiseTo = 0.9;
constexpr double kSearchShare = 0.9;  // share of a row's progress

Scene scene_of(const ContactStudyPlan& plan, const AlgorithmSettings& algorithm) {
  Scene scene = plan.scene;
  scene.axes.resize(1);
  scene.algorithm = algorithm;
  return scene;
}

// False if stopped. `show`: the progress of this search.
bool find_limits(const ContactStudyPlan& plan, const Scene& scene,
                 const ContactStudyOptions& options, const std::function<void(double)>& show,
                 ContactMetrics& metrics) {
  std::vector<Boundary> limits = find_boundaries(
      {scene, {scene.algorithm.index}, std::nullopt, plan.stiffnesses(), plan.tolerance},
      {.threads = options.threads, .should_stop = options.should_stop, .progress = show});
  if (limits.empty()) return false;
  metrics.limits = std::move(limits.front());
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
bool look_at_contact(const Scene& scene, const std::function<bool()>& should_stop,
                     ContactMetrics& metrics) {
  SimulationOptions options;
  options.should_stop = should_stop;
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

bool touches(const Sample& sample) { return (sample.flags & kFlagInContact) != 0; }
bool at_limit(const Sample& sample) { return (sample.flags & kFlagForceLimit) != 0; }

}  // namespace

void FirstContact::add(const Sample& sample) {
  if (phase_ == Phase::kOver) return;
  if (phase_ == Phase::kRising) {
    follow(sample);
  } else if (!touches(sample)) {
    phase_ = Phase::kFree;
    free_force_n_ = sample.force_n;
  } else if (phase_ == Phase::kFree) {
    enter(sample);
  }
}

void FirstContact::enter(const Sample& sample) {
  entry_tick_ = sample.tick;
  speed_m_per_s_ = sample.truth.velocity_m_per_s;
  entry_force_n_ = last_force_n_ = sample.force_n;
  phase_ = at_limit(sample) ? Phase::kOver : Phase::kRising;
}

void FirstContact::follow(const Sample& sample) {
  if (!touches(sample) || sample.force_n < last_force_n_) {
    phase_ = Phase::kOver;
    return;
  }
  last_force_n_ = sample.force_n;
  const double elapsed_s = static_cast<double>(sample.tick - entry_tick_) * period_s_;
  const bool initial = elapsed_s <= kInitialRiseS;
  const bool limited = at_limit(sample);
  const RiseKind kind = limited ? RiseKind::kToTheLimit : RiseKind::kMean;
  if (sample.force_n > entry_force_n_ && (initial || !steepest_n_per_s_)) {
    take((sample.force_n - entry_force_n_) / elapsed_s, kind);
    if (limited) take((sample.force_n - free_force_n_) / (elapsed_s + period_s_), kind);
  }
  if (limited || (!initial && steepest_n_per_s_)) phase_ = Phase::kOver;
}

void FirstContact::take(double slope_n_per_s, RiseKind kind) {
  if (steepest_n_per_s_ && slope_n_per_s <= *steepest_n_per_s_) return;
  steepest_n_per_s_ = slope_n_per_s;
  kind_ = kind;
}

std::optional<double> FirstContact::approach_speed_m_per_s() const {
  if (phase_ == Phase::kUnknown || phase_ == Phase::kFree) return std::nullopt;
  return speed_m_per_s_;
}

std::optional<double> FirstContact::rate_hardness_n_per_m() const {
  const std::optional<double> speed = approach_speed_m_per_s();
  if (!speed || !(*speed > 0.0)) return std::nullopt;
  const double jump_n_per_s = (entry_force_n_ - free_force_n_) / period_s_;
  return steepest_n_per_s_.value_or(jump_n_per_s) / *speed;
}

MapAxis ContactStudyPlan::stiffnesses() const {
  return {find_scene_number(scene, kFirstStiffness).value(), low_n_per_m, high_n_per_m, count,
          true};
}

std::optional<SceneProblem> validate(const ContactStudyPlan& plan) {
  if (plan.scene.x().walls.empty()) {
    return SceneProblem{"wall", "the study varies the stiffness of a wall, and there is none"};
  }
  const MapAxis axis = plan.stiffnesses();
  for (const ComparedAlgorithm& row : compared_algorithms(plan.scene.algorithm, plan.algorithms)) {
    Scene scene = scene_of(plan, row.settings);
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
  const auto compared = compared_algorithms(plan.scene.algorithm, plan.algorithms);
  std::vector<ContactMetrics> rows(compared.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto show = [&, i](double fraction) {
      const double done = static_cast<double>(i) + fraction;
      if (options.progress) options.progress(done / static_cast<double>(rows.size()));
    };
    const auto show_search = [&](double fraction) { show(kSearchShare * fraction); };
    const Scene scene = scene_of(plan, compared[i].settings);
    if (!find_limits(plan, scene, options, show_search, rows[i])) return {};
    if (!look_at_contact(scene, options.should_stop, rows[i])) return {};
    rows[i].summary.algorithm = compared[i].label;
    show(1.0);
  }
  return rows;
}

}  // namespace hapticwall
