// A study of speed against accuracy as text: for people, and for programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/table/text_table.h"
#include "core/study/accuracy.h"

namespace hapticwall::table {

[[nodiscard]] std::span<const Column<AccuracyRow>> accuracy_columns();
// Scene and reference, two lines.
[[nodiscard]] std::string accuracy_heading(const Summary& reference);
// The meaning of the marks in the rows, a line each; "" without marks.
[[nodiscard]] std::string accuracy_marks(const std::vector<AccuracyRow>& rows);

// Two lines of heading, an aligned table, and the meaning of its marks.
[[nodiscard]] std::string accuracy_table(const AccuracyStudy& study);

// One object with the reference and an array of rows (docs/command-line.md), with a line end.
[[nodiscard]] std::string accuracy_json(const AccuracyStudy& study);

// A header and one line per row; `null` is an empty field.
[[nodiscard]] std::string accuracy_csv(const AccuracyStudy& study);

}  // namespace hapticwall::table
