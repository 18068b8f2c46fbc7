// One scene under several algorithms with several hands: the worst and the median of each number.
// Axis x only.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/scene.h"
#include "core/summary.h"

namespace hapticwall {

struct StudiedHand {
  std::string name;
  HandSettings numbers;  // without a path: the hand follows that of the scene
};

struct HandsPlan {
  Scene scene;
  std::vector<StudiedHand> hands;
  std::vector<std::size_t> algorithms;  // indices in algorithms(); compared_algorithms() has rows
};

struct HandsRow {
  std::string algorithm;      // label of compared_algorithms()
  Summary own;                // of the scene's own hand
  std::vector<Summary> runs;  // in the order of HandsPlan::hands; not empty

  // Runs with is_good().
  [[nodiscard]] std::size_t good() const;
  // Index of the run with the worst verdict. Among equal ones that with the most chatter, then with
  // the most energy given, then the first.
  [[nodiscard]] std::size_t worst() const;
  [[nodiscard]] Verdict median_verdict() const;
};

using NumberOfRun = std::optional<double> (*)(const Summary& run);

// The middle of the values; of an even number the larger one of the two in the middle, so that it
// belongs to a run. Runs without the value do not count; nullopt if none has it.
[[nodiscard]] std::optional<double> median_of(const std::vector<Summary>& runs, NumberOfRun number);
[[nodiscard]] std::optional<double> max_of(const std::vector<Summary>& runs, NumberOfRun number);
[[nodiscard]] std::optional<double> min_of(const std::vector<Summary>& runs, NumberOfRun number);

struct HandsOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  std::function<bool()> should_stop;
  // Called by any thread, never by two at once; rises from 0 to 1.
  std::function<void(double fraction)> progress;
};

// A scene without a hand, no hand in the list, or the first hand that the scene cannot have. Runs
// none. Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> validate(const HandsPlan& plan);

// The rows of compared_algorithms(). Every summary has the bits of simulate() on the scene with
// that hand, for any number of threads. Empty if `should_stop` returned true. Precondition:
// validate() returns nullopt. Realtime-safe: no.
[[nodiscard]] std::vector<HandsRow> study_hands(const HandsPlan& plan,
                                                const HandsOptions& options = {});

}  // namespace hapticwall
