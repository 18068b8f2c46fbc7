// hapticwall compare SCENE --study: how stiff and how hard a wall feels under every algorithm, and
// what that costs.
#pragma once

#include <string>
#include <vector>

#include "app/command/common_options.h"
#include "core/study/contact_study.h"

namespace hapticwall::command {

// `algorithms`: names; empty: all. Returns the exit status.
[[nodiscard]] int compare_study(const SceneOptions& scene, const OutputOptions& output,
                                const std::vector<std::string>& algorithms);

// Two lines of conditions, a row an algorithm, and the meaning of the marks that occur.
[[nodiscard]] std::string study_table(const ContactStudyPlan& plan,
                                      const std::vector<ContactFigures>& rows);
// One object, with the conditions, and `rows`.
[[nodiscard]] std::string study_json(const ContactStudyPlan& plan,
                                     const std::vector<ContactFigures>& rows);
// A header and a line an algorithm: the keys of `rows`, those of the conditions repeated in each.
[[nodiscard]] std::string study_csv(const ContactStudyPlan& plan,
                                    const std::vector<ContactFigures>& rows);

}  // namespace hapticwall::command
