// The figures by which the literature ranks stabilising algorithms, on a scene of one's own: how
// stiff a wall each can show, how hard it feels at the touch, and what that costs.
//
// Everything is of axis x; a second axis is left out. The first wall of the scene is the one whose
// stiffness is varied.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "core/study/first_contact.h"
#include "core/study/stability_map.h"
#include "core/summary.h"

namespace hapticwall {

struct ContactStudyPlan {
  Scene scene;
  std::vector<std::size_t> algorithms;  // indices in algorithms(); what follows them is the scene's
  // Stiffnesses of the first wall that are tried, in equal ratios, N/m.
  double low_n_per_m = 100.0;
  double high_n_per_m = 1e6;
  std::size_t count = 97;   // 2 to kMostMapValues
  double tolerance = 1e-3;  // of the refinement, a part of the value

  // Precondition: the scene has a wall.
  [[nodiscard]] MapAxis stiffnesses() const;
};

// The largest stiffness that a hand at rest in a quiet wall is shown.
struct LargestStiffness {
  // N/m: mean force over mean measured penetration, over the ticks in contact of the run's last
  // second (Summary::displayed_stiffness_n_per_m). Of all runs that settle, scan and refinement.
  double displayed_n_per_m = 0.0;
  double wall_n_per_m = 0.0;  // the wall's own stiffness in that run
  // Standard deviation of the command in that last second, N: a run settles by its position, to
  // 0.1 mm, and may still buzz.
  double force_std_n = 0.0;
  // The walls next to it settle up to the scan's last one: what lies beyond was not tried, and
  // `displayed_n_per_m` reads "at least".
  bool open_ended = false;
};

struct ContactFigures {
  // ---- over the scan: the scene with other stiffnesses of its first wall ----
  // The scan, then bisection at the upper end of the settled range in which the stiffest lies. What
  // settles is Summary::verdict, with all that a run of its length can tell. Nothing where no run
  // settles in contact. (Z-width's stiffness, Colgate & Brown 1994, from memory, for this hand and
  // this contact; not for the worst of all hands.)
  std::optional<LargestStiffness> stiffest;
  // The same of the walls that all settle from the scan's softest on, up to the first that does
  // not: where there are islands, the figure to rely on.
  std::optional<LargestStiffness> stiffest_unbroken;
  // Neighbours in the scan that settle are one range; 2 and more: there are islands.
  std::size_t settled_ranges = 0;

  // ---- of the scene as it is ----
  Summary summary;  // verdict, tail_peak_to_peak_m
  // m/s and N/m; see FirstContact.
  std::optional<double> approach_speed_m_per_s;
  std::optional<double> rate_hardness_n_per_m;
  RiseKind rise_kind = RiseKind::kMean;  // where there is a rate-hardness
  // Seconds from the first tick whose command is 10 % of the tail's mean force or more to the first
  // with 90 % (the control engineer's rise time); whole ticks, 0 where one tick does both. First:
  // where the first touch overshoots it is that touch's. Only of a scene that settles under a force
  // above 0. The hand's own slowness is in it.
  std::optional<double> rise_time_s;
  // Of the true position, at the ticks, into the first wall, m; nothing where it is never reached.
  std::optional<double> peak_penetration_m;
  // The most that the hand had taken out at any time, J: max(0, -Summary::passivity_margin_j). 0
  // says that the interface was passive in this run, not that it is.
  double energy_to_hand_j = 0.0;
};

struct ContactStudyOptions {
  std::function<bool()> should_stop;
  // By any thread, but never by two at a time; never falls.
  std::function<void(double fraction)> progress;
};

// Why it cannot be made: a scene without a wall, or the first invalid scene of the scan.
[[nodiscard]] std::optional<SceneProblem> validate(const ContactStudyPlan& plan);

// A row an algorithm, in the order of the plan. Deterministic, whatever the number of threads. An
// empty result: `should_stop` has said so. Precondition: validate() gives nothing. Realtime-safe:
// no.
[[nodiscard]] std::vector<ContactFigures> study_contact(const ContactStudyPlan& plan,
                                                        const ContactStudyOptions& options = {});

}  // namespace hapticwall
