// Measures by which the literature ranks stabilising algorithms, for any scene: the stiffest wall,
// the hardness at the touch, and the energy to the hand. Axis x only. The study varies the
// stiffness of the first wall. docs/study.md defines the measures.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "core/study/boundary.h"
#include "core/study/first_contact.h"
#include "core/summary.h"

namespace hapticwall {

struct ContactStudyPlan {
  Scene scene;
  std::vector<std::size_t> algorithms;  // indices in algorithms(); compared_algorithms() has rows
  // Scanned stiffnesses of the first wall, in equal ratios.
  double low_n_per_m = 100.0;
  double high_n_per_m = 1e6;
  std::size_t count = 926;  // in steps of 1 %; 2 to kMaxMapValues
  double tolerance = 1e-3;  // of the refinement, relative to the value

  // Precondition: the scene has a wall.
  [[nodiscard]] MapAxis stiffnesses() const;
};

struct ContactMetrics {
  // Along the stiffness of the first wall. `limits.failed.first` is the first failure.
  // `limits.at_settled` is the run just below it if the softest wall settles. Its displayed
  // stiffness is that of this hand and contact, and no bound for other hands.
  Boundary limits;
  // Nullopt if the softest wall of the scan does not settle.
  [[nodiscard]] std::optional<Summary> stiffest() const {
    const double settled = limits.settled.first.value_or(0.0);
    const double failed = limits.failed.first.value_or(std::numeric_limits<double>::infinity());
    return failed < settled ? std::nullopt : limits.at_settled;
  }

  // ---- of the unchanged scene ----
  Summary summary;
  // See FirstContact.
  std::optional<double> approach_speed_m_per_s;
  std::optional<double> rate_hardness_n_per_m;
  RiseKind rise_kind = RiseKind::kMean;  // valid with a rate-hardness
  // From the first tick with 10 % of the tail's mean force to the first with 90 %, in whole ticks;
  // may be 0. nullopt unless the scene settles with a positive force. It includes the slowness of
  // the hand.
  std::optional<double> rise_time_s;
  // Of the true position at the ticks, into the first wall; nullopt if never reached.
  std::optional<double> peak_penetration_m;
  // Maximum over time of the energy that the hand extracted: max(0, -passivity_margin_j). 0 means
  // that this run was passive, not that the interface is.
  double energy_to_hand_j = 0.0;
};

struct ContactStudyOptions {
  int threads = 0;  // max; 0: as many as the processor runs at a time
  std::function<bool()> should_stop;
  // Called by any thread, never by two at once; monotonic.
  std::function<void(double fraction)> progress;
};

// A missing wall, or the first invalid scene of the scan.
[[nodiscard]] std::optional<SceneProblem> validate(const ContactStudyPlan& plan);

// The rows of compared_algorithms(), with their labels as `summary.algorithm`; independent of the
// number of threads. Empty if `should_stop` returned true. Precondition: validate() returns
// nullopt. Realtime-safe: no.
[[nodiscard]] std::vector<ContactMetrics> study_contact(const ContactStudyPlan& plan,
                                                        const ContactStudyOptions& options = {});

}  // namespace hapticwall
