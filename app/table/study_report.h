// A contact study as a table, as JSON and as CSV.
#pragma once

#include <string>
#include <vector>

#include "app/table/text_table.h"
#include "core/study/contact_study.h"

namespace hapticwall::table {

// Its heading states the conditions of the scene and of the scan, in two lines.
[[nodiscard]] Sheet study_sheet(const ContactStudyPlan& plan,
                                const std::vector<ContactMetrics>& rows);
// One object, with the conditions, and `rows`.
[[nodiscard]] std::string study_json(const ContactStudyPlan& plan,
                                     const std::vector<ContactMetrics>& rows);
// A header and one line per row, each with the conditions and the keys of its row.
[[nodiscard]] std::string study_csv(const ContactStudyPlan& plan,
                                    const std::vector<ContactMetrics>& rows);

}  // namespace hapticwall::table
