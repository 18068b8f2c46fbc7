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

// Algorithm and walls as they are from this tick on; of the plant only the tables that differ from
// those of the start.
void write_change(TomlText& out, const Scene& start, const RecordedChange& change) {
  const Scene& scene = change.scene;
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

}  // namespace

std::string sidecar_toml(Scene scene, const RecordingMetadata& metadata,
                         const RecordedRows& recorded) {
  if (recorded.session_ticks > 0 && recorded.session_ticks != scene.tick_count()) {
    scene.duration_s = static_cast<double>(recorded.session_ticks) / scene.sampling.rate_hz;
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
  out.boolean("repeatable", metadata.repeatable);
  if (!metadata.repeatable) {
    out.string("not_repeatable_because", metadata.not_repeatable_because);
  }
  if (recorded.finished) out.string("csv_sha256", recorded.csv_sha256);
  for (const RecordedChange& change : metadata.changes) write_change(out, scene, change);
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

bool may_replace_sidecar(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return true;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line == "[recording]" || line == "[map]") return true;
  }
  return false;
}

}  // namespace hapticwall::file
