#include "core/study/worst_hand/worst_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "core/run/batch_simulator.h"
#include "core/run/metrics.h"
#include "core/study/worst_hand/cma_es.h"
#include "core/study/worst_hand/random.h"
#include "core/study/worst_hand/sobol.h"

namespace hapticwall::worst_hand {
namespace {

constexpr std::size_t kFirstHands = 1024;
constexpr std::size_t kRestartHands = 256;
constexpr std::array<std::size_t, 3> kPopulations{32, 64, 96};
constexpr double kNeighbourhood = 0.01;
// Hands that are ranked differ by more than this in a number: the hands that took most are often
// copies of one lucky hand.
constexpr double kDistinct = 0.1;

// N after the path's end. Add the values in the order of time.
class RestEnergy {
 public:
  explicit RestEnergy(double rest_s) : rest_s_(rest_s) {}

  void add(double time_s, double net_work_j) {
    if (time_s < rest_s_) return;
    if (!at_rest_j_) at_rest_j_ = std::min(net_work_j, 0.0);
    least_j_ = std::min(least_j_, net_work_j);
  }
  [[nodiscard]] double taken_j() const {
    return at_rest_j_ ? std::max(0.0, *at_rest_j_ - least_j_) : 0.0;
  }

 private:
  double rest_s_;
  std::optional<double> at_rest_j_;
  double least_j_ = std::numeric_limits<double>::infinity();
};

double taken_j(const Summary& run) { return std::max(0.0, -run.passivity_margin_j.value_or(0.0)); }

double score_of(const Summary& run, double taken_at_rest_j) {
  constexpr double kSmall = 1e-12;  // every hand that takes energy ranks above
  if (taken_at_rest_j > kFoundJ) return taken_at_rest_j;
  const double lost_j = run.true_dissipation_j.value_or(0.0);
  const double given_j = -run.true_actuator_work_j.value_or(0.0);
  return kSmall * ((lost_j > 0.0 ? std::clamp(given_j / lost_j, -1.0, 1.0) : -1.0) - 1.0);
}

// nullopt if the runs were stopped. Throws SceneRefused.
std::optional<std::vector<HandResult>> run_scenes(std::span<const Scene> scenes, Motion motion,
                                                  const SearchOptions& options) {
  std::vector<RestEnergy> energies;
  BatchOptions batch{.threads = options.threads,
                     .should_stop = options.should_stop,
                     .progress = {},
                     .on_sample = {}};
  if (motion == Motion::kRamp) {
    for (const Scene& scene : scenes) energies.emplace_back(rest_s(scene));
    batch.on_sample = [&](std::size_t scene, const Sample& sample) {
      energies[scene].add(sample.time_s, sample.truth.hand_work_j);
    };
  }
  const BatchResult result = simulate_batch(scenes, batch);
  if (result.stopped_early) return std::nullopt;
  std::vector<HandResult> runs;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Summary& summary = *result.summaries[i];
    double taken = taken_j(summary);
    if (motion == Motion::kRamp) {
      energies[i].add(summary.duration_s, *summary.true_hand_work_j);
      taken = energies[i].taken_j();
    }
    runs.push_back({score_of(summary, taken), taken_j(summary), taken});
  }
  return runs;
}

bool are_distinct(const HandValues& a, const HandValues& b) {
  for (std::size_t i = 0; i < kHandNumbers; ++i) {
    if (std::abs(a.at(i) - b.at(i)) > kDistinct * std::max(a.at(i), b.at(i))) return true;
  }
  return false;
}

// Every hand gets the same offsets, so that their medians compare.
std::vector<HandValues> neighbours_of(const HandValues& values, std::size_t numbers,
                                      std::uint64_t seed) {
  Random random(seed);
  std::vector<HandValues> neighbours(kNeighbours, values);
  for (HandValues& neighbour : neighbours) {
    for (double& value : std::span(neighbour).first(numbers))
      value *= 1.0 + kNeighbourhood * (2.0 * random.uniform() - 1.0);
  }
  return neighbours;
}

class Search {
 public:
  Search(const Plan& plan, const SearchOptions& options)
      : plan_(plan), options_(options), random_(plan.seed), sobol_(random_, numbers()) {}

  std::optional<Found> run() {
    for (HandPoint start = best_of_new(kFirstHands); !over(); start = best_of_new(kRestartHands)) {
      const std::size_t population = kPopulations.at(climbs_++ % kPopulations.size());
      plan_.motion == Motion::kRamp ? climb<number_count(Motion::kRamp)>(start, population)
                                    : climb<number_count(Motion::kLetGo)>(start, population);
    }
    rank();
    if (stopped_) return std::nullopt;
    tell_progress(1.0);
    return std::move(found_);
  }

 private:
  struct Tried {
    HandValues values;
    double taken_j;
    double taken_at_rest_j;
  };

  [[nodiscard]] std::size_t numbers() const { return number_count(plan_.motion); }

  [[nodiscard]] bool over() {
    return stopped_ || found_.hands >= plan_.hands ||
           (options_.time_is_up && options_.time_is_up());
  }
  void tell_progress(double fraction) const {
    if (options_.progress) options_.progress(fraction);
  }

  HandPoint best_of_new(std::size_t count) {
    if (over() && found_.hands > 0) return {};
    std::vector<HandPoint> points(count);
    for (HandPoint& point : points) point = sobol_.next();
    const std::vector<double> scores = try_hands(points);
    return scores.empty() ? HandPoint{}
                          : points[static_cast<std::size_t>(std::ranges::max_element(scores) -
                                                            scores.begin())];
  }

  template <std::size_t kNumbers>
  void climb(const HandPoint& start, std::size_t population) {
    CmaEs<kNumbers> climber(start, population);
    while (!over() && !climber.is_over()) {
      const std::vector<double> scores = try_hands(climber.ask(random_));
      if (scores.size() < population) return;
      climber.tell(scores);
    }
  }

  // Scores of the points, or of the first of them if the hands run out.
  std::vector<double> try_hands(std::vector<HandPoint> points) {
    points.resize(std::min<std::size_t>(points.size(), plan_.hands - found_.hands));
    std::vector<HandValues> hands;
    hands.reserve(points.size());
    for (const HandPoint& point : points) hands.push_back(values_at(point, plan_.bounds));
    const HandResults runs = run(hands);
    std::vector<double> scores;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      ++found_.hands;
      const double taken = runs[i] ? runs[i]->taken_at_rest_j : 0.0;
      found_.refused += runs[i] ? 0U : 1U;
      scores.push_back(runs[i] ? runs[i]->score : -1.0);
      if (!(taken > kFoundJ)) continue;
      if (taken > found_.most_j()) found_.gains.push_back({found_.hands, taken});
      tried_.push_back({hands[i], runs[i]->taken_j, taken});
    }
    tell_progress(static_cast<double>(found_.hands) / planned_runs());
    return scores;
  }
  [[nodiscard]] double planned_runs() const {
    return static_cast<double>(plan_.hands + kMaxRanked * kNeighbours);
  }

  HandResults run(std::span<const HandValues> hands) {
    std::optional<HandResults> results =
        options_.run_hands ? options_.run_hands(hands) : run_hands(plan_, hands, options_);
    if (!results) stopped_ = true;
    return results ? std::move(*results) : HandResults{};
  }

  // The hands that took most, without copies of a better one.
  std::vector<Tried> best_distinct() {
    std::ranges::stable_sort(tried_, std::ranges::greater(), &Tried::taken_at_rest_j);
    std::vector<Tried> best;
    for (const Tried& tried : tried_) {
      if (best.size() == kMaxRanked) break;
      if (std::ranges::all_of(
              best, [&](const Tried& other) { return are_distinct(tried.values, other.values); })) {
        best.push_back(tried);
      }
    }
    return best;
  }

  void rank() {
    const std::uint64_t seed = random_.bits();
    const std::vector<Tried> best = best_distinct();
    for (std::size_t i = 0; i < best.size() && !stopped_; ++i) {
      std::vector<double> taken = taken_by(neighbours_of(best[i].values, numbers(), seed));
      if (stopped_) return;
      std::ranges::sort(taken);
      const double median = 0.5 * (taken[kNeighbours / 2 - 1] + taken[kNeighbours / 2]);
      if (!found_.hand || median > found_.hand->typical_j) {
        found_.hand =
            FoundHand{best[i].values, {}, best[i].taken_j, best[i].taken_at_rest_j, median,
                      taken.front(),  {}};
      }
      const auto runs = static_cast<double>(found_.hands + (i + 1) * kNeighbours);
      tell_progress(runs / planned_runs());
    }
    if (!found_.hand || stopped_) return;
    found_.hand->scene = with_hand(plan_.scene, found_.hand->values, plan_.motion);
    found_.hand->last_second_w = last_second_w(found_.hand->scene);
  }
  std::vector<double> taken_by(const std::vector<HandValues>& hands) {
    std::vector<double> taken;
    for (const std::optional<HandResult>& result : run(hands))
      taken.push_back(result ? result->taken_at_rest_j : 0.0);
    return taken;
  }

  // A shorter run is the first part of the longer one.
  std::optional<double> last_second_w(const Scene& scene) {
    const SimulationOptions stoppable{
        .on_sample = {}, .should_stop = options_.should_stop, .changes = {}};
    const SimulationResult whole = simulate(scene, stoppable);
    Scene shorter = scene;
    shorter.duration_s = whole.summary.duration_s - kTailS;
    if (shorter.duration_s * scene.sampling.rate_hz < 0.5) return std::nullopt;
    const SimulationResult part = simulate(shorter, stoppable);
    stopped_ = whole.stopped_early || part.stopped_early;
    return (*part.summary.true_hand_work_j - *whole.summary.true_hand_work_j) / kTailS;
  }

  const Plan& plan_;
  const SearchOptions& options_;
  Random random_;
  Sobol sobol_;
  std::size_t climbs_ = 0;
  Found found_;
  std::vector<Tried> tried_;  // hands that took energy
  bool stopped_ = false;
};

}  // namespace

std::optional<HandResults> run_hands(const Plan& plan, std::span<const HandValues> hands,
                                     const SearchOptions& options) {
  std::vector<Scene> scenes;
  scenes.reserve(hands.size());
  for (const HandValues& hand : hands) scenes.push_back(with_hand(plan.scene, hand, plan.motion));
  std::vector<std::size_t> places(hands.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  HandResults results(hands.size());
  for (;;) try {
      const auto batch = run_scenes(scenes, plan.motion, options);
      if (!batch) return std::nullopt;
      for (std::size_t i = 0; i < places.size(); ++i) results[places[i]] = (*batch)[i];
      return results;
    } catch (const SceneRefused& refused) {
      const auto index = static_cast<std::ptrdiff_t>(refused.scene);
      scenes.erase(scenes.begin() + index);
      places.erase(places.begin() + index);
    }
}

std::optional<Found> search(const Plan& plan, const SearchOptions& options) {
  return Search(plan, options).run();
}

}  // namespace hapticwall::worst_hand
