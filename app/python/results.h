// Results of runs, as Python reads them.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/file/recording/recording_rows.h"
#include "core/run/simulate.h"
#include "core/sample.h"
#include "core/summary.h"

namespace hapticwall::python {

// Rows of samples, those of an axis beside each other, as NumPy reads them in place.
struct Rows {
  file::CsvColumns columns;
  std::vector<Sample> samples;  // row by row, in each axis by axis

  void append(const Tick& tick);
};

// The columns of a recording, with ascending offsets: name, NumPy format, and place in a row in
// bytes.
struct RowLayout {
  std::vector<std::string> names;
  std::vector<std::string> formats;
  std::vector<std::size_t> offsets;
  std::size_t row_bytes = 0;
};
[[nodiscard]] RowLayout layout_of(const file::CsvColumns& columns);

[[nodiscard]] RunSummary summaries_of(const AxesResult& result);
// The keys of the command line's JSON; None for what does not apply.
using SummaryDict = nanobind::typed<nanobind::dict, nanobind::str, nanobind::any>;
[[nodiscard]] SummaryDict summary_dict(const RunSummary& run);

// A key of summaries with its numbers, NaN for what does not apply. "verdict" is an index.
struct NumberColumn {
  std::string_view name;
  std::vector<double> values;
};
// A column for each key that has numbers, with room for this many. Needs no interpreter.
[[nodiscard]] std::vector<NumberColumn> number_columns(std::size_t rows);
void append(std::vector<NumberColumn>& columns, std::span<const Summary> rows);
using Column = nanobind::ndarray<nanobind::numpy, double, nanobind::ndim<1>>;
using SummaryColumns = nanobind::typed<nanobind::dict, nanobind::str, Column>;
[[nodiscard]] SummaryColumns python_columns(std::vector<NumberColumn> columns);

}  // namespace hapticwall::python
