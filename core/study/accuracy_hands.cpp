#include "core/study/accuracy_hands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/run/batch_simulator.h"

namespace hapticwall {
namespace {

constexpr std::array kStepped{Integrator::kSemiImplicitEuler, Integrator::kRungeKutta4};

void add_hands(const AccuracyHandsPlan& plan, const SimulatorSettings& simulator,
               std::vector<Scene>& scenes) {
  const double stiffness = plan.scene.x().hand->stiffness_n_per_m;
  for (std::size_t i = 0; i < plan.hands; ++i) {
    Scene& scene = scenes.emplace_back(plan.scene);
    scene.simulator = simulator;
    scene.x().hand->stiffness_n_per_m = hand_stiffness(stiffness, i, plan.hands);
  }
}

void compare_with(std::span<const Summary> exact, std::span<const Summary> runs,
                  AccuracyHandsRow& row) {
  for (std::size_t i = 0; i < exact.size(); ++i) {
    row.verdicts_agree += runs[i].verdict == exact[i].verdict ? 1 : 0;
    if (exact[i].verdict != Verdict::kOscillating) continue;
    ++row.compared;
    if (!exact[i].tail_peak_to_peak_m || !runs[i].tail_peak_to_peak_m) continue;
    const double error =
        std::abs(*runs[i].tail_peak_to_peak_m / *exact[i].tail_peak_to_peak_m - 1.0);
    row.within += error <= kRightAmplitude ? 1 : 0;
    row.max_error = std::max(row.max_error.value_or(0.0), error);
  }
}

}  // namespace

std::size_t AccuracyHands::oscillating() const {
  return static_cast<std::size_t>(
      std::ranges::count(exact, Verdict::kOscillating, &Summary::verdict));
}

double hand_stiffness(double scene_n_per_m, std::size_t index, std::size_t hands) {
  const double place = static_cast<double>(index) / static_cast<double>(hands - 1);
  return scene_n_per_m * (1.0 + kHandSpread * (2.0 * place - 1.0));
}

std::optional<SceneProblem> validate(const AccuracyHandsPlan& plan) {
  const std::optional<HandSettings>& hand = plan.scene.x().hand;
  if (hand && hand->stiffness_n_per_m > 0.0) return std::nullopt;
  return SceneProblem{"hand.stiffness_n_per_m",
                      "several hands differ in their stiffness, and this scene's hand has none"};
}

std::optional<AccuracyHands> measure_hands(const AccuracyHandsPlan& plan,
                                           const AccuracyHandsOptions& options) {
  AccuracyHands measured;
  std::vector<Scene> scenes;
  add_hands(plan, {Integrator::kExact, 1}, scenes);
  for (const Integrator integrator : kStepped) {
    for (const int substeps : plan.substeps) {
      measured.rows.push_back({integrator, substeps, 0, 0, 0, {}});
      add_hands(plan, {integrator, substeps}, scenes);
    }
  }
  const auto progress = [&](std::size_t done, std::size_t total) {
    if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(total));
  };
  const std::vector<Summary> summaries = simulate_all(
      scenes,
      {.threads = options.threads, .should_stop = options.should_stop, .progress = progress});
  if (summaries.empty()) return std::nullopt;
  const std::span<const Summary> all(summaries);
  const auto exact = all.first(plan.hands);
  measured.exact.assign(exact.begin(), exact.end());
  for (std::size_t i = 0; i < measured.rows.size(); ++i)
    compare_with(exact, all.subspan((i + 1) * plan.hands, plan.hands), measured.rows[i]);
  return measured;
}

}  // namespace hapticwall
