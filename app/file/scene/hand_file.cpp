#include "app/file/scene/hand_file.h"

#include <fmt/format.h>

#include <filesystem>
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

Result<PathPoint> hand_point(std::string_view line, const std::vector<PathPoint>& before) {
  const std::vector<std::string_view> fields = split(line, ',');
  if (fields.size() != 2) {
    return usage_error(fmt::format("{} columns; it takes 2: {}", fields.size(), kHandHeader));
  }
  const Result<double> time_s = hand_number(fields[0], kPathTimeRange, "time_s", "s");
  if (!time_s) return time_s.error();
  const Result<double> position_m = hand_number(fields[1], kPositionRange, "position_m", "m");
  if (!position_m) return position_m.error();
  if (!before.empty() && !(*time_s > before.back().time_s)) {
    return usage_error(fmt::format("time_s: {} follows {}; times must increase",
                                   number_text(*time_s), number_text(before.back().time_s)));
  }
  return PathPoint{*time_s, *position_m};
}

bool is_hand_header(std::string_view line) {
  const std::vector<std::string_view> names = split(line, ',');
  return names.size() == 2 && trimmed(names[0]) == "time_s" && trimmed(names[1]) == "position_m";
}

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
  if (!is_hand_header(header)) {
    return usage_error(
        fmt::format("{}:1: not the header of a hand; it takes {}", shown(origin), kHandHeader));
  }
  std::vector<PathPoint> points;
  while (!text.empty()) {
    const Result<PathPoint> point = hand_point(take_line(text), points);
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
