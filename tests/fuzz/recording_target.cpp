// The CSV of a recording: any text.
#include <cmath>
#include <string>
#include <string_view>

#include "app/file/recording/recording_rows.h"
#include "app/file/recording/recording_scan.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/text_promises.h"

namespace hapticwall::fuzz {
namespace {

using file::RecordingScan;
using file::ScannedRows;

const std::string kOrigin = "fuzz.csv";

// Scans `text` in two pieces, cut at `cut`.
Result<ScannedRows> scanned(std::string_view text, std::size_t cut, file::Tolerance tolerance) {
  RecordingScan scan(kOrigin, tolerance);
  for (const std::string_view piece : {text.substr(0, cut), text.substr(cut)}) {
    if (Failure failed = scan.take(piece)) return *std::move(failed);
  }
  return scan.finish();
}

bool same(const Result<ScannedRows>& a, const Result<ScannedRows>& b) {
  if (a.ok() != b.ok()) return false;
  if (!a) return a.error().message == b.error().message;
  return a->rows == b->rows && a->first_tick == b->first_tick && a->last_tick == b->last_tick &&
         a->end_offset == b->end_offset && a->missing_rows == b->missing_rows;
}

// A row that was taken is written as a row that is read as the same.
void require_repeatable(std::string_view line, const file::CsvColumns& columns) {
  Tick tick;
  require(!file::parse_csv_row(line, columns, tick), "a row that was taken is taken again");
  require(is_finite(tick), "a row that was taken is finite");
  std::string written;
  file::append_csv_row(written, tick, columns);
  Tick again;
  require(
      !file::parse_csv_row(std::string_view(written).substr(0, written.size() - 1), columns, again),
      "a row that was written can be read");
  std::string twice;
  file::append_csv_row(twice, again, columns);
  require(written == twice, "a row that was read is the same");
}

Outcome fuzz_one(Bytes input) {
  const std::string_view text = text_of(input);
  const Result<ScannedRows> rows = scanned(text, 0, {});
  require(same(rows, scanned(text, text.size() / 2, {})), "pieces may be cut anywhere");
  const Result<ScannedRows> tolerated = scanned(text, 0, {.holes = true, .cut_off = true});
  if (!tolerated) require_one_clean_line(tolerated.error(), kOrigin);
  if (!rows) {
    require_one_clean_line(rows.error(), kOrigin);
    return Outcome::kRefused;
  }
  require(same(rows, tolerated), "who forgives more takes the same");
  require(rows->rows > 0 && rows->last_tick - rows->first_tick == rows->rows - 1,
          "there is a row a tick");
  require(!rows->rate_hz || (std::isfinite(*rows->rate_hz) && *rows->rate_hz > 0.0),
          "a rate is a rate");
  std::string_view rest = text.substr(text.find('\n') + 1);
  for (std::uint64_t row = 0; row < rows->rows; ++row) {
    const std::size_t end = rest.find('\n');
    require_repeatable(rest.substr(0, end), rows->columns);
    rest.remove_prefix(end + 1);
  }
  require(rest.empty(), "all of it is rows");
  return Outcome::kTaken;
}

const Registered kRegistered({"recording", fuzz_one});

}  // namespace
}  // namespace hapticwall::fuzz
