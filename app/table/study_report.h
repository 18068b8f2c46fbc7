// A contact study as a table, as JSON and as CSV.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/table/text_table.h"
#include "core/study/contact_study.h"

namespace hapticwall::table {

[[nodiscard]] std::span<const Column<ContactMetrics>> study_columns();
// Conditions of the scene and of the scan, two lines.
[[nodiscard]] std::string study_heading(const ContactStudyPlan& plan,
                                        const std::vector<ContactMetrics>& rows);
// The meaning of the marks in the rows, a line each; "" without marks.
[[nodiscard]] std::string study_marks(const std::vector<ContactMetrics>& rows);

// Heading, rows, marks.
[[nodiscard]] std::string study_table(const ContactStudyPlan& plan,
                                      const std::vector<ContactMetrics>& rows);
// One object, with the conditions, and `rows`.
[[nodiscard]] std::string study_json(const ContactStudyPlan& plan,
                                     const std::vector<ContactMetrics>& rows);
// A header and one line per row, each with the conditions and the keys of its row.
[[nodiscard]] std::string study_csv(const ContactStudyPlan& plan,
                                    const std::vector<ContactMetrics>& rows);

}  // namespace hapticwall::table
