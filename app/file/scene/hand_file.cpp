#include "app/file/scene/hand_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "core/scene_keys.h"

namespace hapticwall::file {
namespace {

namespace fs = std::filesystem;

// The next line without its end, which may be \r\n; `text` continues behind it.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// A number of a row, or the reason why the field holds none.
Result<double> hand_number(std::string_view field, const ValueRange& range, std::string_view name,
                           std::string_view unit) {
  const std::optional<double> value = parsed<double>(trimmed(field));
  if (!value) return usage_error(fmt::format("{}: no finite number", name));
  if (range.contains(*value)) return *value;
  return usage_error(fmt::format("{}: {}", name, out_of_range_text(*value, range, unit)));
}

// Places of the two columns among the fields of a row, which may have others.
struct HandColumns {
  std::size_t count = 0;
  std::size_t time = 0;
  std::size_t position = 0;
};

// nullopt if a column is missing or stands twice.
std::optional<HandColumns> hand_columns(std::string_view header) {
  const std::vector<std::string_view> names = split(header, ',');
  HandColumns columns{names.size(), names.size(), names.size()};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string_view name = trimmed(names[i]);
    if (name != "time_s" && name != "position_m") continue;
    std::size_t& place = name == "time_s" ? columns.time : columns.position;
    if (place != names.size()) return std::nullopt;
    place = i;
  }
  const bool whole = columns.time < names.size() && columns.position < names.size();
  return whole ? std::optional(columns) : std::nullopt;
}

// A clock that starts outside the times of a path, such as seconds since 1970, begins at 0.
double begin_of(double first_time_s) {
  return kPathTimeRange.contains(first_time_s) ? 0.0 : first_time_s;
}

// Reads the rows of one file.
class HandReader {
 public:
  explicit HandReader(const HandColumns& columns) : columns_(columns) {}

  Result<PathPoint> point(std::string_view line) {
    const std::vector<std::string_view> fields = split(line, ',');
    if (fields.size() != columns_.count) {
      return usage_error(
          fmt::format("{} columns; the header has {}", fields.size(), columns_.count));
    }
    const Result<double> clock_s = hand_number(fields[columns_.time], kAnyTime, "time_s", "s");
    if (!clock_s) return clock_s.error();
    if (first_) begin_s_ = begin_of(*clock_s);
    const double time_s = *clock_s - begin_s_;
    if (!kPathTimeRange.contains(time_s))
      return usage_error("time_s: " + out_of_range_text(time_s, kPathTimeRange, "s"));
    if (!first_ && !(time_s > before_s_)) {
      return usage_error(fmt::format("time_s: {} follows {}; times must increase",
                                     number_text(time_s), number_text(before_s_)));
    }
    const Result<double> position_m =
        hand_number(fields[columns_.position], kPositionRange, "position_m", "m");
    if (!position_m) return position_m.error();
    before_s_ = time_s;
    first_ = false;
    return PathPoint{time_s, *position_m};
  }

 private:
  static constexpr ValueRange kAnyTime{-1e11, 1e11};  // s; a double still tells 20 µs apart

  HandColumns columns_;
  bool first_ = true;
  double begin_s_ = 0.0;   // of the clock
  double before_s_ = 0.0;  // time of the last point
};

}  // namespace

// A message quotes no text of the file, because the author of the scene chose the file: it could be
// /etc/shadow.
Result<std::vector<PathPoint>> parse_hand(std::string_view text, const std::string& origin) {
  text = without_byte_order_mark(text);
  const std::string_view header = take_line(text);
  if (header.starts_with("tick,time_s,")) {
    return usage_error(shown(origin) +
                       ":1: a recording; `compare`, `map` and `accuracy` re-run its hand if it is "
                       "their SCENE");
  }
  const std::optional<HandColumns> columns = hand_columns(header);
  if (!columns) {
    return usage_error(
        fmt::format("{}:1: not the header of a hand; it takes {}", shown(origin), kHandHeader));
  }
  std::vector<PathPoint> points;
  HandReader reader(*columns);
  while (!text.empty()) {
    const Result<PathPoint> point = reader.point(take_line(text));
    if (!point) {
      return usage_error(
          fmt::format("{}:{}: {}", shown(origin), points.size() + 2, point.error().message));
    }
    points.push_back(*point);
  }
  if (points.empty()) return usage_error(fmt::format("{}:2: no point of a hand", shown(origin)));
  return points;
}

Result<SharedPath> read_hand_file(const std::string& path) {
  const Result<std::string> text = read_small_file(path, "hand", kMaxHandBytes, problem_of_named);
  if (!text) return text.error();
  Result<std::vector<PathPoint>> points = parse_hand(*text, path);
  if (!points) return points.error();
  Sha256 digest;
  digest.update(*text);
  SharedPath hand(std::move(*points));
  std::error_code failed;
  hand.file = fs::absolute(path, failed).lexically_normal().string();
  hand.sha256 = digest.finish();
  return hand;
}

Scene beside(Scene scene, const std::string& written) {
  std::error_code failed;
  const fs::path folder = fs::weakly_canonical(fs::absolute(written, failed).parent_path(), failed);
  for (AxisSettings& axis : scene.axes) {
    if (!axis.hand || axis.hand->path.file.empty()) continue;
    const fs::path file = fs::weakly_canonical(axis.hand->path.file, failed);
    axis.hand->path.file = file.lexically_proximate(folder).string();
  }
  return scene;
}

}  // namespace hapticwall::file
