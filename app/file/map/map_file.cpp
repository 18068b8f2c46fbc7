#include "app/file/map/map_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "app/file/disk/small_file.h"
#include "app/file/map/map_rows.h"
#include "app/file/plugin/plugin_file.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/hand_file.h"
#include "app/file/scene/scene_file.h"
#include "app/file/scene/toml_text.h"
#include "app/file/text/text.h"
#include "core/algorithm/algorithm.h"
#include "hapticwall_version.h"

namespace hapticwall::file {
namespace {

std::string axis_text(const MapAxis& axis) {
  return fmt::format("{}={}:{}:{}{}", axis.number.path, shortest_number(axis.low),
                     shortest_number(axis.high), axis.count, axis.logarithmic ? ":log" : "");
}

std::string algorithms_text(const StabilityMap& map) {
  std::vector<std::string_view> names;
  for (const std::size_t index : map.algorithms) names.push_back(algorithms()[index].name);
  return fmt::format("{}", fmt::join(names, ","));
}

// Another file of the same name must not resume the map.
std::string plugins_text(const StabilityMap& map) {
  std::string text;
  for (const std::size_t index : map.algorithms) {
    const PluginFile* const plugin = plugin_file(index);
    if (plugin == nullptr) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", plugin->path, plugin->sha256);
  }
  return text;
}

// Empty if there is no such file.
std::string contents(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool is_empty(const std::string& path) {
  std::error_code failed;
  return std::filesystem::file_size(path, failed) == 0 || failed;
}

// True if the partial rows belong to the map with this sidecar. The finished sidecar counts only
// without a partial one: then the run ended between the two renames.
bool is_of_map(const std::string& sidecar_path, const std::string& sidecar_text) {
  const std::string partial = partial_of(sidecar_path);
  return contents(is_empty(partial) ? sidecar_path : partial) == sidecar_text;
}

// The complete sidecar on the disk, under its partial name. An equal one is kept: a full disk could
// prevent writing it again, and the rows are lost without it.
Result<AtomicFile> open_sidecar(const std::string& path, const std::string& text) {
  Result<AtomicFile> file = AtomicFile::resume(path);
  if (!file) return file;
  if (contents(file->partial_path()) == text) {
    file->keep_partial();
  } else {
    if (Failure failed = file->keep_only(0)) return *failed;
    if (Failure failed = file->write(text)) return *failed;
  }
  if (Failure failed = file->sync()) return *failed;
  file->keep_partial();
  return file;
}

struct FoundRows {
  std::vector<MapMetrics> metrics;
  std::size_t bytes = 0;  // size of the header and the whole lines
};

// The leading complete lines of `text` that are the header and cells of the part.
FoundRows whole_rows(std::string_view text, const StabilityMap& map, const MapPart& part) {
  FoundRows rows;
  if (part.begin == 0) {
    const std::string header = map_header(map);
    if (!text.starts_with(header)) return rows;
    rows.bytes = header.size();
  }
  while (part.begin + rows.metrics.size() < part.end) {
    const std::string_view rest = text.substr(rows.bytes);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) break;
    const auto metrics = parse_map_row(rest.substr(0, end), map, part.begin + rows.metrics.size());
    if (!metrics) break;
    rows.metrics.push_back(*metrics);
    rows.bytes += end + 1;
  }
  return rows;
}

}  // namespace

MapPart map_part(const StabilityMap& map, std::size_t index, std::size_t count) {
  const std::size_t cells = map.cell_count();
  // Quotient and remainder separately, to avoid an overflow.
  const auto begin = [&](std::size_t i) { return cells / count * i + cells % count * i / count; };
  return {begin(index - 1), begin(index)};
}

std::string map_sidecar(const StabilityMap& map, const MapPart& part, const std::string& path) {
  TomlText out;
  out.table("map");
  out.string("program", "hapticwall");
  out.string("version", kVersion);
  out.string("build", kBuild);
  out.string("x", axis_text(map.x));
  out.string("y", axis_text(map.y));
  out.string("algorithms", algorithms_text(map));
  if (const std::string plugins = plugins_text(map); !plugins.empty())
    out.string("plugins", plugins);
  out.integer("first_cell", part.begin);
  out.integer("cells", part.end - part.begin);
  return scene_to_toml(beside(map.scene, path)) + out.text();
}

Result<MapWriter> MapWriter::open(const std::string& named, const StabilityMap& map,
                                  const MapPart& part) {
  const Result<std::string> place = replaceable_path(named);
  if (!place) return place.error();
  const std::string& path = *place;
  const std::string sidecar_path = sidecar_path_of(path);
  const std::string obstacle = sidecar_obstacle(sidecar_path, kMapTable);
  if (!obstacle.empty()) {
    return file_error(fmt::format("{}: the sidecar of {} would replace {}; choose another name",
                                  shown(sidecar_path), shown(path), obstacle));
  }
  const std::string partial = partial_of(path);
  const std::string sidecar_text = map_sidecar(map, part, path);
  if (!is_empty(partial) && !is_of_map(sidecar_path, sidecar_text)) {
    return file_error(
        fmt::format("{}: it belongs to another map or build; finish it with its own "
                    "command, or remove it",
                    shown(partial)));
  }
  Result<AtomicFile> csv = AtomicFile::resume(path);
  if (!csv) return csv.error();
  csv->keep_partial();
  FoundRows rows = whole_rows(contents(partial), map, part);
  if (Failure failed = csv->keep_only(rows.bytes)) return *failed;
  Result<AtomicFile> sidecar = open_sidecar(sidecar_path, sidecar_text);
  if (!sidecar) return sidecar.error();
  if (rows.bytes == 0 && part.begin == 0) {
    if (Failure failed = csv->write(map_header(map))) return *failed;
  }
  MapWriter writer(std::move(*csv), std::move(*sidecar));
  writer.found_ = std::move(rows.metrics);
  return writer;
}

Failure MapWriter::append(const StabilityMap& map, std::size_t begin,
                          const std::vector<MapMetrics>& metrics) {
  std::string text;
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    append_map_row(text, map, begin + i, metrics[i]);
  }
  return csv_.write(text);
}

Failure MapWriter::finish() {
  // The sidecar first, so that a finished CSV always has one.
  if (Failure failed = sidecar_.commit()) return failed;
  return csv_.commit();
}

Result<std::vector<MapMetrics>> parse_map(std::string_view text, const std::string& origin,
                                          const StabilityMap& map) {
  const std::size_t cells = map.cell_count();
  FoundRows rows = whole_rows(text, map, {0, cells});
  if (rows.bytes == 0) {
    return usage_error(fmt::format("{}:1: not the header of this map: {}", shown(origin),
                                   map_header(map).substr(0, map_header(map).size() - 1)));
  }
  if (rows.metrics.size() < cells) {
    const std::size_t cell = rows.metrics.size();
    return usage_error(fmt::format(
        "{}:{}: not cell {} of the {} of this map: expected '{}', a verdict and {} "
        "numbers or empty fields",
        shown(origin), cell + 2, cell + 1, cells, map_row_beginning(map, cell), kMapMetrics));
  }
  if (rows.bytes != text.size()) {
    return usage_error(fmt::format("{}:{}: unexpected text after the last cell of this map",
                                   shown(origin), cells + 2));
  }
  return std::move(rows.metrics);
}

bool has_other_sidecar(const std::string& path, const StabilityMap& map) {
  const std::string sidecar_path = sidecar_path_of(path);
  return is_sidecar(sidecar_path, kMapTable) &&
         contents(sidecar_path) != map_sidecar(map, {0, map.cell_count()}, path);
}

Result<std::vector<MapMetrics>> read_map(const std::string& path, const StabilityMap& map) {
  if (access(path.c_str(), R_OK) != 0) return cannot_be_read(path, errno);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return usage_error(shown(path) + ": not a map: not a file");
  }
  const std::string text = contents(path);
  if (text.empty()) return usage_error(shown(path) + ": not a map: empty");
  return parse_map(text, path, map);
}

}  // namespace hapticwall::file
