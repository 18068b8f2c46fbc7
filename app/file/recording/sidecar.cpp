#include "app/file/recording/sidecar.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/file/disk/atomic_file.h"
#include "app/file/scene/seal.h"
#include "app/file/scene/toml_text.h"
#include "core/scene_keys.h"
#include "hapticwall_version.h"

namespace hapticwall::file {
namespace {

constexpr std::string_view kChangePrefix = "recording.change.";

// Writes algorithm and walls, and of environment, estimator and plant the tables that differ from
// the start. The scenes come without their paths.
void write_change(TomlText& out, const Scene& start, const ScheduledChange& change) {
  const Scene scene = without_paths(change.scene);
  out.table_of_array("recording.change");
  out.integer("tick", change.tick);
  for (std::size_t i = 0; i < std::min(scene.axes.size(), start.axes.size()); ++i) {
    const AxisSettings& axis = scene.axes[i];
    if (axis.device != start.axes[i].device) {
      write_numbers(out, axis_key("recording.change.device", i), axis.device);
    }
    if (axis.hand && axis.hand != start.axes[i].hand) {
      write_numbers(out, axis_key("recording.change.hand", i), *axis.hand);
    }
  }
  const SamplingSettings sampling = scene.sampling.with_clock_of(start.sampling);
  if (sampling != start.sampling) write_numbers(out, "recording.change.sampling", sampling);
  if (scene.simulator != start.simulator) write_simulator(out, kChangePrefix, scene.simulator);
  write_algorithm(out, kChangePrefix, scene.algorithm);
  if (scene.environment != start.environment)
    write_environment(out, kChangePrefix, scene.environment);
  if (scene.estimator != start.estimator) write_estimator(out, kChangePrefix, scene.estimator);
  write_walls(out, kChangePrefix, scene);
}

// Only the tick is read back; the time is for people.
void write_mark(TomlText& out, const Mark& mark, double rate_hz) {
  out.table_of_array("recording.mark");
  out.integer("tick", mark.tick);
  out.number("time_s", static_cast<double>(mark.tick) / rate_hz);
  if (!mark.text.empty()) out.string("text", mark.text);
}

// Sets the duration of the whole session, if known. Returns false, and changes nothing, if a scene
// cannot be that long.
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
  if (recorded.finished && recorded.rows == 0 && recorded.dropped_rows == 0) {
    not_repeatable_because = "it has no tick";
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
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    const auto tick = metadata.diverged_at_tick.at(axis);
    if (tick) out.integer(kDivergedKeys.at(axis), *tick);
  }
  if (metadata.recovered) out.boolean("recovered", true);
  out.integer("first_tick", metadata.first_tick);
  const bool repeatable = metadata.repeatable && not_repeatable_because.empty();
  out.boolean("repeatable", repeatable);
  if (!repeatable) out.string("not_repeatable_because", not_repeatable_because);
  if (recorded.finished) out.string("csv_sha256", recorded.csv_sha256);
  const Scene start = without_paths(scene);
  for (const ScheduledChange& change : metadata.changes) write_change(out, start, change);
  for (const Mark& mark : metadata.marks) write_mark(out, mark, scene.sampling.rate_hz);
  return sealed(scene_to_toml(scene) + out.text());
}

std::string sidecar_path_of(const std::string& csv_path) {
  constexpr std::string_view kCsvEnding = ".csv";
  std::string path = csv_path;
  if (path.ends_with(kPartialEnding)) {
    path.resize(path.size() - kPartialEnding.size());
    return partial_of(sidecar_path_of(path));
  }
  if (path.ends_with(kCsvEnding)) path.resize(path.size() - kCsvEnding.size());
  return path + ".toml";
}

std::string find_sidecar(const std::string& csv_path) {
  std::error_code failed;
  const auto file = std::filesystem::canonical(csv_path, failed);
  const std::string beside_file = sidecar_path_of(file.string());
  const bool linked = !failed && std::filesystem::is_symlink(csv_path, failed);
  return linked && std::filesystem::exists(beside_file, failed) ? beside_file
                                                                : sidecar_path_of(csv_path);
}

Failure write_sidecar(const std::string& csv_path, std::string_view text) {
  const std::string path = sidecar_path_of(csv_path);
  const std::string partial = partial_of(path);
  if (Failure failed = write_file(partial, text)) return failed;
  return rename_file(partial, path);
}

std::string sidecar_obstacle(const std::string& path, std::string_view table) {
  std::error_code ignored;
  const auto status = std::filesystem::symlink_status(path, ignored);
  if (!std::filesystem::exists(status)) return "";
  if (std::filesystem::is_symlink(status)) return "a link";
  if (!is_sidecar(path, table)) return fmt::format("a file that is not a {}'s", table);
  const bool read_only =
      (status.permissions() & std::filesystem::perms::owner_write) == std::filesystem::perms::none;
  return read_only ? "a read-only file" : "";
}

}  // namespace hapticwall::file
