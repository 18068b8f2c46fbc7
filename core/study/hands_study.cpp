#include "core/study/hands_study.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/algorithm/algorithm.h"
#include "core/run/batch_simulator.h"

namespace hapticwall {
namespace {

std::vector<double> ascending(const std::vector<Summary>& runs, NumberOfRun number) {
  std::vector<double> values;
  for (const Summary& run : runs) {
    if (const auto value = number(run)) values.push_back(*value);
  }
  std::ranges::sort(values);
  return values;
}

Scene scene_with(const Scene& scene, const HandSettings& numbers) {
  Scene changed = scene;
  HandSettings hand = numbers;
  hand.path = scene.x().hand->path;
  changed.x().hand = std::move(hand);
  return changed;
}

// The own hand first, then the hands of the plan.
std::vector<Scene> scenes_of(const HandsPlan& plan, const AlgorithmSettings& settings) {
  std::vector<Scene> scenes{plan.scene};
  for (const StudiedHand& hand : plan.hands) scenes.push_back(scene_with(plan.scene, hand.numbers));
  for (Scene& scene : scenes) scene.algorithm = settings;
  return scenes;
}

}  // namespace

std::size_t HandsRow::good() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(runs, [](const Summary& run) { return is_good(run.verdict); }));
}

std::size_t HandsRow::worst() const {
  const auto badness = [](const Summary& run) {
    return std::tuple(run.verdict, run.chatter_n.value_or(0.0), run.given_j);
  };
  return static_cast<std::size_t>(std::ranges::max_element(runs, {}, badness) - runs.begin());
}

Verdict HandsRow::median_verdict() const {
  std::vector<Verdict> verdicts;
  verdicts.reserve(runs.size());
  for (const Summary& run : runs) verdicts.push_back(run.verdict);
  std::ranges::sort(verdicts);
  return verdicts[verdicts.size() / 2];
}

std::optional<double> median_of(const std::vector<Summary>& runs, NumberOfRun number) {
  const std::vector<double> values = ascending(runs, number);
  return values.empty() ? std::nullopt : std::optional(values[values.size() / 2]);
}

std::optional<double> max_of(const std::vector<Summary>& runs, NumberOfRun number) {
  const std::vector<double> values = ascending(runs, number);
  return values.empty() ? std::nullopt : std::optional(values.back());
}

std::optional<double> min_of(const std::vector<Summary>& runs, NumberOfRun number) {
  const std::vector<double> values = ascending(runs, number);
  return values.empty() ? std::nullopt : std::optional(values.front());
}

std::optional<SceneProblem> validate(const HandsPlan& plan) {
  if (!plan.scene.x().hand)
    return SceneProblem{"hand", "the scene has no hand that others replace"};
  if (plan.hands.empty()) return SceneProblem{"hand", "the list has no hand"};
  for (const StudiedHand& hand : plan.hands) {
    auto problem = validate(scene_with(plan.scene, hand.numbers));
    if (problem) return SceneProblem{problem->key, hand.name + ": " + problem->message};
  }
  return std::nullopt;
}

std::vector<HandsRow> study_hands(const HandsPlan& plan, const HandsOptions& options) {
  const auto compared = compared_algorithms(plan.scene.algorithm, plan.algorithms);
  std::vector<Scene> scenes;
  for (const ComparedAlgorithm& row : compared) {
    for (Scene& scene : scenes_of(plan, row.settings)) scenes.push_back(std::move(scene));
  }
  const auto progress = [&](std::size_t done, std::size_t total) {
    if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(total));
  };
  std::vector<Summary> summaries = simulate_all(
      scenes,
      {.threads = options.threads, .should_stop = options.should_stop, .progress = progress});
  std::vector<HandsRow> rows;
  if (summaries.empty()) return rows;
  auto next = summaries.begin();
  for (const ComparedAlgorithm& row : compared) {
    HandsRow& made = rows.emplace_back();
    made.algorithm = row.label;
    made.own = std::move(*next++);
    for (std::size_t i = 0; i < plan.hands.size(); ++i) made.runs.push_back(std::move(*next++));
  }
  return rows;
}

}  // namespace hapticwall
