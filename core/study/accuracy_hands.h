// How many of several hands an integrator renders with the right amplitude: one hand can flatter
// it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

inline constexpr std::size_t kMaxAccuracyHands = 1001;
// The stiffness of the hands is from 1 - kHandSpread to 1 + kHandSpread of that of the scene.
inline constexpr double kHandSpread = 0.05;
// Relative error of the tail's amplitude up to which a run counts as right.
inline constexpr double kRightAmplitude = 0.01;

struct AccuracyHandsPlan {
  Scene scene;
  std::vector<int> substeps;  // each from 1 to kMaxSubsteps
  std::size_t hands = 21;     // 2 to kMaxAccuracyHands; stiffness in equal steps
};

// An integrator and its substeps, over all hands.
struct AccuracyHandsRow {
  Integrator integrator = Integrator::kSemiImplicitEuler;
  int substeps = 1;
  std::size_t compared = 0;  // hands that oscillate with `exact`
  std::size_t within = 0;    // of these, hands with an amplitude within kRightAmplitude of `exact`
  std::size_t verdicts_agree = 0;   // hands with the verdict of `exact`
  std::optional<double> max_error;  // largest relative error of the amplitude; nullopt if none
};

struct AccuracyHands {
  std::vector<Summary> exact;          // in the order of rising stiffness
  std::vector<AccuracyHandsRow> rows;  // integrator by integrator in the order of `substeps`
  // Hands that oscillate with `exact`: only they have an amplitude to compare.
  [[nodiscard]] std::size_t oscillating() const;
};

struct AccuracyHandsOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  std::function<bool()> should_stop;
  // Called by any thread, never by two at once; rises from 0 to 1.
  std::function<void(double fraction)> progress;
};

// Stiffness of hand `index` of `hands`, N/m. Preconditions: hands > 1, index < hands.
[[nodiscard]] double hand_stiffness(double scene_n_per_m, std::size_t index, std::size_t hands);

// A scene whose hand has no stiffness to vary. Runs none. Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const AccuracyHandsPlan& plan);

// The runs of all integrators and hands, on axis x; measures no time. Independent of the number of
// threads. nullopt if `should_stop` returned true. Precondition: validate() returns nullopt.
// Realtime-safe: no.
[[nodiscard]] std::optional<AccuracyHands> measure_hands(const AccuracyHandsPlan& plan,
                                                         const AccuracyHandsOptions& options = {});

}  // namespace hapticwall
