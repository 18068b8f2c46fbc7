// hapticwall compare SCENE --study: stiffness and hardness of a wall under every algorithm, and
// their cost.
#pragma once

#include <string>
#include <vector>

#include "app/command/common_options.h"
#include "core/study/contact_study.h"

namespace hapticwall::command {

// `algorithms`: names; empty: all. Returns the exit status.
[[nodiscard]] Result<int> compare_study(const SceneOptions& scene, const OutputOptions& output,
                                        const std::vector<std::string>& algorithms);

// Two lines of conditions, the rows, and the meaning of the marks.
[[nodiscard]] std::string study_table(const ContactStudyPlan& plan,
                                      const std::vector<ContactMetrics>& rows);
// One object, with the conditions, and `rows`.
[[nodiscard]] std::string study_json(const ContactStudyPlan& plan,
                                     const std::vector<ContactMetrics>& rows);
// A header and one line per row, each with the conditions and the keys of its row.
[[nodiscard]] std::string study_csv(const ContactStudyPlan& plan,
                                    const std::vector<ContactMetrics>& rows);

}  // namespace hapticwall::command
