// A study of speed against accuracy as text: for people, and for programs.
#pragma once

#include <string>

#include "app/table/text_table.h"
#include "core/study/accuracy.h"

namespace hapticwall::table {

// Its heading names scene and reference, in two lines.
[[nodiscard]] Sheet accuracy_sheet(const AccuracyStudy& study);

// One object with the reference and an array of rows (docs/command-line.md), with a line end.
[[nodiscard]] std::string accuracy_json(const AccuracyStudy& study);

// A header and one line per row; `null` is an empty field.
[[nodiscard]] std::string accuracy_csv(const AccuracyStudy& study);

}  // namespace hapticwall::table
