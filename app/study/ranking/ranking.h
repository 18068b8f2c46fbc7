// The ranking of the algorithms on a scene, as a study: stiffness and hardness of a wall under
// every algorithm, and their cost. It is the mode `hapticwall compare SCENE --study`.
#pragma once

#include <vector>

#include "app/study/study.h"
#include "core/study/contact_study.h"

namespace hapticwall::study::ranking {

// `rows`: one for each algorithm of the plan.
[[nodiscard]] Outcome outcome_of(const ContactStudyPlan& plan,
                                 const std::vector<ContactMetrics>& rows);

}  // namespace hapticwall::study::ranking
