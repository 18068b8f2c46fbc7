#include "core/study/boundary.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/batch/batch_simulator.h"

namespace hapticwall {
namespace {

struct Search {
  Boundary found;
  Scene scene;  // without the searched number
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

bool settles(const Summary& summary) { return summary.verdict == Verdict::kSettled; }

// `scan`: in the order of the values.
void take_scan(const BoundaryPlan& plan, std::span<Summary> scan, Boundary& found) {
  std::optional<std::size_t> change;  // first value after it
  for (std::size_t i = 1; i < scan.size(); ++i) {
    if (settles(scan[i]) == settles(scan[i - 1])) continue;
    ++found.changes;
    if (!change) change = i;
  }
  const std::size_t end = settles(scan.front()) ? scan.size() - 1 : 0;
  const std::size_t last = change ? *change - 1 : end;
  const auto take = [&](std::size_t i) {
    if (!settles(scan[i])) {
      found.unsettled = plan.along.value(i);
      return;
    }
    found.settled = plan.along.value(i);
    found.at_settled = std::move(scan[i]);
  };
  if (change) take(*change);
  take(last);
}

bool is_open(const BoundaryPlan& plan, const Boundary& found) {
  if (!found.settled || !found.unsettled) return false;
  const double larger = std::max(std::abs(*found.settled), std::abs(*found.unsettled));
  return std::abs(*found.unsettled - *found.settled) > plan.tolerance * larger;
}

double middle(const BoundaryPlan& plan, const Boundary& found) {
  const double value = plan.along.logarithmic
                           ? std::sqrt(*found.settled) * std::sqrt(*found.unsettled)
                           : 0.5 * (*found.settled + *found.unsettled);
  return plan.along.number.whole ? std::floor(value) : value;
}

// One step of all open searches; false if stopped.
bool bisect(const BoundaryPlan& plan, std::vector<Search*>& open, const BoundaryOptions& options) {
  std::vector<Scene> scenes;
  scenes.reserve(open.size());
  for (const Search* search : open) {
    scenes.push_back(scene_at(plan, *search, middle(plan, search->found)));
  }
  std::vector<Summary> summaries =
      simulate_all(scenes, {.should_stop = options.should_stop, .progress = {}});
  if (summaries.size() != open.size()) return false;
  for (std::size_t i = 0; i < open.size(); ++i) {
    Boundary& found = open[i]->found;
    const double value = middle(plan, found);
    // The two ends are adjacent doubles.
    const bool stuck = value == *found.settled || value == *found.unsettled;
    if (settles(summaries[i])) {
      found.settled = value;
      found.at_settled = std::move(summaries[i]);
    } else {
      found.unsettled = value;
    }
    if (stuck || !is_open(plan, found)) open[i] = nullptr;
  }
  std::erase(open, nullptr);
  return true;
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
  std::vector<Summary> scan =
      simulate_all(scenes, {.should_stop = options.should_stop, .progress = {}});
  if (scan.size() != scenes.size()) return {};
  std::vector<Search*> open;
  for (std::size_t i = 0; i < searches.size(); ++i) {
    take_scan(plan, std::span(scan).subspan(i * plan.along.count, plan.along.count),
              searches[i].found);
    if (is_open(plan, searches[i].found)) open.push_back(&searches[i]);
  }
  const double steps = std::ceil(std::log2(1.0 / plan.tolerance));
  for (double step = 1.0; !open.empty(); ++step) {
    if (options.progress) options.progress(std::min(1.0, step / (steps + 1.0)));
    if (!bisect(plan, open, options)) return {};
  }
  std::vector<Boundary> boundaries;
  boundaries.reserve(searches.size());
  for (Search& search : searches) boundaries.push_back(std::move(search.found));
  return boundaries;
}

}  // namespace hapticwall
