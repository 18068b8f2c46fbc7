#include "app/file/recording/recording_scan.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

// The largest tick that a double holds exactly.
constexpr std::uint64_t kLastTick = (std::uint64_t{1} << 53U) - 1;

// Most rates are whole numbers; the last row gives the rate to rounding.
std::optional<double> rate_of(const Sample& sample) {
  if (sample.tick == 0 || !(sample.time_s > 0.0)) return std::nullopt;
  const auto ticks = static_cast<double>(sample.tick);
  const double rate_hz = ticks / sample.time_s;
  const double whole_hz = std::round(rate_hz);
  if (!std::isfinite(rate_hz)) return std::nullopt;
  return whole_hz > 0.0 && ticks / whole_hz == sample.time_s ? whole_hz : rate_hz;
}

}  // namespace

Error RecordingScan::problem(std::string_view text) const {
  return usage_error(fmt::format("{}:{}: {}", shown(origin_), line_, text));
}

Failure RecordingScan::take(std::string_view piece) {
  while (!piece.empty()) {
    const std::size_t end = piece.find('\n');
    const std::string_view part = piece.substr(0, end);
    if (begun_.size() + part.size() > kMaxCsvLineBytes) {
      ++line_;
      return problem(fmt::format("longer than {} bytes: no row of a recording", kMaxCsvLineBytes));
    }
    if (end == std::string_view::npos) {
      begun_ += part;
      return {};
    }
    if (begun_.empty()) {
      if (Failure failed = take_line(part)) return failed;
    } else {
      begun_ += part;
      if (Failure failed = take_line(begun_)) return failed;
      begun_.clear();
    }
    piece.remove_prefix(end + 1);
  }
  return {};
}

Failure RecordingScan::take_line(std::string_view line) {
  if (line.ends_with('\r')) {
    ++line_;
    return problem("its end is of another system, \\r\\n; the lines of a recording end with \\n");
  }
  if (line_++ > 0) return take_row(line);
  const Result<CsvColumns> columns = parse_csv_header(line);
  if (!columns) return problem(columns.error().message);
  rows_.columns = *columns;
  rows_.end_offset = line.size() + 1;
  return {};
}

Failure RecordingScan::take_row(std::string_view line) {
  if (const auto wrong = parse_csv_row(line, rows_.columns, tick_)) return problem(*wrong);
  const std::uint64_t tick = tick_.x().tick;
  if (Failure failed = check_tick(tick)) return failed;
  if (rows_.rows % kRowsPerBlock == 0) rows_.blocks.push_back({rows_.end_offset, tick});
  if (rows_.rows++ == 0) rows_.first_tick = tick;
  rows_.last_tick = tick;
  rows_.end_offset += line.size() + 1;
  return {};
}

Failure RecordingScan::check_tick(std::uint64_t tick) {
  if (tick > kLastTick) return problem(fmt::format("tick {}: no session lasts so long", tick));
  if (rows_.rows == 0 || tick == rows_.last_tick + 1) return {};
  if (tick <= rows_.last_tick) {
    return problem(fmt::format("tick {} follows tick {}; it should be {}", tick, rows_.last_tick,
                               rows_.last_tick + 1));
  }
  const std::uint64_t missing = tick - rows_.last_tick - 1;
  if (!tolerance_.holes) {
    return problem(fmt::format("tick {} follows tick {}: {} missing", tick, rows_.last_tick,
                               missing == 1 ? "1 row is" : fmt::format("{} rows are", missing)));
  }
  rows_.missing_rows += missing;
  return {};
}

Result<ScannedRows> RecordingScan::finish() {
  if (line_ == 0) {
    return usage_error(fmt::format("{}: not a recording: {}", shown(origin_),
                                   begun_.empty() ? "empty" : "its header has no line end"));
  }
  if (!begun_.empty()) {
    ++line_;
    if (!tolerance_.cut_off) return problem("the last line is cut off: it has no line end");
    rows_.cut_off = true;
  }
  if (rows_.rows == 0) {
    return usage_error(shown(origin_) + ": a recording without rows");
  }
  rows_.rate_hz = rate_of(tick_.x());
  return std::move(rows_);
}

}  // namespace hapticwall::file
