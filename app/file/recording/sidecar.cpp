#include "app/file/sidecar.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "app/file/atomic_file.h"
#include "app/file/scene_file.h"
#include "app/file/toml_text.h"
#include "hapticwall_version.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kChangePrefix = "recording.change.";

void write_second_change(TomlText& out, const SecondAxis& start, const SecondAxis& axis) {
  if (axis.device != start.device) write_device(out, "recording.change.device.y", axis.device);
  if (axis.hand && axis.hand != start.hand) {
    write_hand_numbers(out, "recording.change.hand.y", *axis.hand);
  }
}

// A path does not change in a session, and may be long.
Scene without_paths(Scene scene) {
  if (scene.hand) scene.hand->path.clear();
  if (scene.y && scene.y->hand) scene.y->hand->path.clear();
  return scene;
}

// Algorithm and walls as they are from this tick on; of the plant only the tables that differ from
// those of the start. Both without their paths.
void write_change(TomlText& out, const Scene& start, const RecordedChange& change) {
  const Scene scene = without_paths(change.scene);
  out.table_of_array("recording.change");
  out.integer("tick", change.tick);
  if (scene.device != start.device) write_device(out, "recording.change.device", scene.device);
  if (scene.hand && scene.hand != start.hand) {
    write_hand_numbers(out, "recording.change.hand", *scene.hand);
  }
  if (scene.y && start.y) write_second_change(out, *start.y, *scene.y);
  if (scene.simulator != start.simulator) write_simulator(out, kChangePrefix, scene.simulator);
  write_algorithm(out, kChangePrefix, scene.algorithm);
  write_walls(out, kChangePrefix, scene);
}

// The tick is what counts; the time is for people.
void write_mark(TomlText& out, const Mark& mark, double rate_hz) {
  out.table_of_array("recording.mark");
  out.integer("tick", mark.tick);
  out.number("time_s", static_cast<double>(mark.tick) / rate_hz);
  if (!mark.text.empty()) out.string("text", mark.text);
}

// Of the whole session, where it is known. False where a scene cannot be that long: then it stays
// as it was.
bool take_duration(Scene& scene, std::uint64_t session_ticks) {
  if (session_ticks == 0 || session_ticks == scene.tick_count()) return true;
  Scene longer = scene;
  longer.duration_s = static_cast<double>(session_ticks) / scene.sampling.rate_hz;
  if (validate(longer)) return false;
  scene.duration_s = longer.duration_s;
  return true;
}

}  // namespace

std::string sidecar_toml(Scene scene, const RecordingMetadata& metadata,
                         const RecordedRows& recorded) {
  std::string not_repeatable_because =
      metadata.repeatable ? std::string() : metadata.not_repeatable_because;
  if (!take_duration(scene, recorded.session_ticks) && metadata.repeatable) {
    not_repeatable_because = "the session was longer than a scene can be";
  }
  TomlText out;
  out.table("recording");
  out.string("program", "hapticwall");
  out.string("version", kVersion);
  out.string("build", kBuild);
  if (!metadata.start_time.empty()) out.string("start_time", metadata.start_time);
  out.string("device", metadata.device);
  out.string("realtime", metadata.realtime_status);
  out.integer("rows", recorded.rows);
  out.integer("dropped_rows", recorded.dropped_rows);
  out.boolean("complete", recorded.finished && recorded.dropped_rows == 0);
  if (metadata.recovered) out.boolean("recovered", true);
  out.integer("first_tick", metadata.first_tick);
  const bool repeatable = metadata.repeatable && not_repeatable_because.empty();
  out.boolean("repeatable", repeatable);
  if (!repeatable) out.string("not_repeatable_because", not_repeatable_because);
  if (recorded.finished) out.string("csv_sha256", recorded.csv_sha256);
  const Scene start = without_paths(scene);
  for (const RecordedChange& change : metadata.changes) write_change(out, start, change);
  for (const Mark& mark : metadata.marks) write_mark(out, mark, scene.sampling.rate_hz);
  return scene_to_toml(scene) + out.text();
}

std::string sidecar_path_of(const std::string& csv_path) {
  constexpr std::string_view kCsvEnding = ".csv";
  std::string path = csv_path;
  if (path.ends_with(kPartialEnding)) {
    path.resize(path.size() - kPartialEnding.size());
    return sidecar_path_of(path) + std::string(kPartialEnding);
  }
  if (path.ends_with(kCsvEnding)) path.resize(path.size() - kCsvEnding.size());
  return path + ".toml";
}

Failure write_sidecar(const std::string& csv_path, std::string_view text) {
  const std::string path = sidecar_path_of(csv_path);
  const std::string partial = path + std::string(kPartialEnding);
  if (Failure failed = write_file(partial, text)) return failed;
  return rename_file(partial, path);
}

bool may_replace_sidecar(const std::string& path, std::string_view table) {
  std::error_code ignored;
  return !std::filesystem::exists(path, ignored) || is_sidecar(path, table);
}

bool is_sidecar(const std::string& path, std::string_view table) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return false;
  if (std::filesystem::file_size(path, failed) > kLargestSidecarBytes || failed) return false;
  const std::string first_line = fmt::format("[{}]", table);
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line == first_line) return true;
  }
  return false;
}

}  // namespace hapticwall::file
