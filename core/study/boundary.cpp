#include "core/study/boundary.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/run/batch_simulator.h"
#include "core/study/stability_bounds.h"

namespace hapticwall {
namespace {

// A change of verdict between two values.
struct Change {
  double settled = 0.0;
  double failed = 0.0;
  std::optional<Summary> at_settled;
};

struct Search {
  Boundary found;
  Scene scene;                  // without the searched number
  std::vector<Change> changes;  // the first, and the last if it is another
};

std::vector<Search> searches_of(const BoundaryPlan& plan) {
  std::vector<Search> searches;
  for (std::size_t algorithm = 0; algorithm < plan.algorithms.size(); ++algorithm) {
    for (std::size_t i = 0; i < (plan.x ? plan.x->count : 1); ++i) {
      Search search;
      search.found.algorithm = algorithm;
      search.scene = plan.scene;
      search.scene.algorithm.index = plan.algorithms[algorithm];
      if (plan.x) {
        search.found.x = plan.x->value(i);
        plan.x->number.set(search.scene, *search.found.x);
      }
      searches.push_back(std::move(search));
    }
  }
  return searches;
}

Scene scene_at(const BoundaryPlan& plan, const Search& search, double value) {
  Scene scene = search.scene;
  plan.along.number.set(scene, value);
  return scene;
}

// A wall that is not touched is no limit: the bisection counts it as good, the scan skips it.
bool settles(const Summary& summary) {
  return is_good(summary.verdict) || summary.verdict == Verdict::kNoContact;
}

// `scan`: in the order of the values.
void take_scan(const BoundaryPlan& plan, std::span<Summary> scan, Search& search) {
  Boundary& found = search.found;
  std::vector<std::pair<std::size_t, std::size_t>> changes;  // values before and after each
  std::optional<std::size_t> before;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan[i].verdict == Verdict::kNoContact) continue;
    Extent& extent = settles(scan[i]) ? found.settled : found.failed;
    if (!extent.first) extent.first = plan.along.value(i);
    extent.last = plan.along.value(i);
    if (before && settles(scan[i]) != settles(scan[*before])) changes.emplace_back(*before, i);
    before = i;
  }
  found.changes = changes.size();
  if (changes.empty()) {
    if (before && settles(scan[*before])) found.at_settled = std::move(scan[*before]);
    return;
  }
  if (changes.size() > 1) changes = {changes.front(), changes.back()};
  for (const auto& [left, right] : changes) {
    const bool falls = settles(scan[left]);
    const std::size_t settled = falls ? left : right;
    const std::size_t failed = falls ? right : left;
    search.changes.push_back({plan.along.value(settled), plan.along.value(failed), scan[settled]});
  }
}

double middle(const BoundaryPlan& plan, const Change& change) {
  const double value = plan.along.logarithmic ? std::sqrt(change.settled) * std::sqrt(change.failed)
                                              : 0.5 * (change.settled + change.failed);
  return plan.along.number.whole ? std::floor(value) : value;
}

bool is_open(const BoundaryPlan& plan, const Change& change) {
  const double larger = std::max(std::abs(change.settled), std::abs(change.failed));
  const double value = middle(plan, change);  // equals one end if the two ends are adjacent doubles
  return std::abs(change.failed - change.settled) > plan.tolerance * larger &&
         value != change.settled && value != change.failed;
}

struct OpenChange {
  const Search* search;
  Change* change;
};

// Runs scenes and reports the finished share of all expected runs.
class Runner {
 public:
  Runner(const BoundaryPlan& plan, const BoundaryOptions& options) : options_(options) {
    constexpr double kChanges = 2.0;  // max of a search
    const double steps = std::ceil(std::log2(1.0 / plan.tolerance));
    total_ = static_cast<double>(plan.boundary_count()) *
             (static_cast<double>(plan.along.count) + kChanges * steps);
  }

  // Empty if stopped.
  std::vector<Summary> run(const std::vector<Scene>& scenes) {
    const auto show = [&](std::size_t done, std::size_t) {
      const double runs = done_ + static_cast<double>(done);
      if (options_.progress) options_.progress(std::min(1.0, runs / total_));
    };
    std::vector<Summary> summaries = simulate_all(
        scenes,
        {.threads = options_.threads, .should_stop = options_.should_stop, .progress = show});
    done_ += static_cast<double>(scenes.size());
    return summaries;
  }

 private:
  const BoundaryOptions& options_;
  double total_ = 0.0;
  double done_ = 0.0;
};

// Bisects every open change once; false if stopped.
bool bisect(const BoundaryPlan& plan, const std::vector<OpenChange>& open, Runner& runner) {
  std::vector<Scene> scenes;
  scenes.reserve(open.size());
  for (const OpenChange& each : open) {
    scenes.push_back(scene_at(plan, *each.search, middle(plan, *each.change)));
  }
  std::vector<Summary> summaries = runner.run(scenes);
  if (summaries.empty()) return false;
  for (std::size_t i = 0; i < open.size(); ++i) {
    Change& change = *open[i].change;
    const double value = middle(plan, change);
    if (settles(summaries[i])) {
      change.settled = value;
      change.at_settled = std::move(summaries[i]);
    } else {
      change.failed = value;
    }
  }
  return true;
}

// The scan's extents, with the ends at changes of verdict refined.
Boundary result_of(const BoundaryPlan& plan, Search search) {
  Boundary found = std::move(search.found);
  if (plan.along.number.path == "wall.stiffness_n_per_m") {
    found.stable_below_n_per_m = exact_stable_limit(search.scene);
  }
  if (search.changes.empty()) return found;
  const Change& first = search.changes.front();
  const Change& last = search.changes.back();
  if (first.settled < first.failed) {
    found.failed.first = first.failed;
  } else {
    found.settled.first = first.settled;
  }
  if (last.settled < last.failed) {
    found.settled.last = last.settled;
  } else {
    found.failed.last = last.failed;
  }
  found.at_settled = std::move(search.changes.front().at_settled);
  return found;
}

}  // namespace

std::optional<SceneProblem> validate(const BoundaryPlan& plan) {
  for (const Search& search : searches_of(plan)) {
    for (std::size_t i = 0; i < plan.along.count; ++i) {
      if (auto problem = validate(scene_at(plan, search, plan.along.value(i)))) return problem;
    }
  }
  return std::nullopt;
}

std::vector<Boundary> find_boundaries(const BoundaryPlan& plan, const BoundaryOptions& options) {
  std::vector<Search> searches = searches_of(plan);
  std::vector<Scene> scenes;
  for (const Search& search : searches) {
    for (std::size_t i = 0; i < plan.along.count; ++i) {
      scenes.push_back(scene_at(plan, search, plan.along.value(i)));
    }
  }
  Runner runner(plan, options);
  std::vector<Summary> scan = runner.run(scenes);
  if (scan.empty()) return {};
  for (std::size_t i = 0; i < searches.size(); ++i) {
    take_scan(plan, std::span(scan).subspan(i * plan.along.count, plan.along.count), searches[i]);
  }
  std::vector<OpenChange> open;
  for (Search& search : searches) {
    for (Change& change : search.changes) open.push_back({&search, &change});
  }
  const auto closed = [&](const OpenChange& each) { return !is_open(plan, *each.change); };
  for (std::erase_if(open, closed); !open.empty(); std::erase_if(open, closed)) {
    if (!bisect(plan, open, runner)) return {};
  }
  std::vector<Boundary> boundaries;
  boundaries.reserve(searches.size());
  for (Search& search : searches) boundaries.push_back(result_of(plan, std::move(search)));
  return boundaries;
}

}  // namespace hapticwall
