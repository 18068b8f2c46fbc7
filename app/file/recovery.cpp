#include "app/file/recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "app/file/atomic_file.h"
#include "app/file/recording_reader.h"
#include "app/file/sha256.h"
#include "app/file/sidecar.h"
#include "app/file/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kRowsAtATime = 1024;
constexpr std::size_t kPieceBytes = std::size_t{1} << 16U;

Error usage_error(std::string message) { return {ErrorKind::kUsage, std::move(message)}; }

// The first tick of a change that nobody knows, if a row tells of one.
Result<std::optional<std::uint64_t>> find_unknown_change(RecordingReader& reader) {
  const std::vector<ScheduledChange>& changes = reader.info().loaded.changes;
  const auto is_known = [&](std::uint64_t tick) {
    return std::ranges::any_of(changes,
                               [&](const ScheduledChange& change) { return change.tick == tick; });
  };
  std::vector<Sample> samples(kRowsAtATime);
  for (std::uint64_t row = 0; row < reader.rows();) {
    const Result<std::size_t> count = reader.read(row, samples);
    if (!count) return count.error();
    for (std::size_t i = 0; i < *count; ++i) {
      const bool changed = (samples[i].flags & kFlagParametersChanged) != 0;
      if (changed && !is_known(samples[i].tick)) return std::optional(samples[i].tick);
    }
    row += *count;
  }
  return std::optional<std::uint64_t>();
}

// Of the first `bytes` of a file, as they are: somebody may have edited the rows by hand.
Result<std::string> sha256_of(const std::string& path, std::uint64_t bytes) {
  std::ifstream in(path, std::ios::binary);
  std::string piece(kPieceBytes, '\0');
  Sha256 digest;
  while (bytes > 0) {
    const std::uint64_t wanted = std::min<std::uint64_t>(bytes, piece.size());
    if (!in.read(piece.data(), static_cast<std::streamsize>(wanted))) {
      return usage_error(shown(path) + ": changed while it was read");
    }
    digest.update(std::string_view(piece).substr(0, wanted));
    bytes -= wanted;
  }
  return digest.finish();
}

RecordingMetadata metadata_of(const RecordingInfo& info,
                              std::optional<std::uint64_t> unknown_change) {
  const std::uint64_t end_tick = info.scanned.last_tick + 1;
  RecordingMetadata metadata;
  metadata.start_time = info.start_time;
  metadata.device = info.device;
  metadata.realtime_status = info.realtime;
  metadata.first_tick = info.scanned.first_tick;
  metadata.dropped_rows = info.scanned.missing_rows;
  metadata.recovered = true;
  metadata.not_repeatable_because = info.loaded.not_repeatable_because;
  if (unknown_change) {
    metadata.not_repeatable_because = fmt::format(
        "parameters changed at tick {}, just before the session was cut off, and "
        "nobody knows how",
        *unknown_change);
  }
  metadata.repeatable = metadata.not_repeatable_because.empty();
  for (const ScheduledChange& change : info.loaded.changes) {
    if (change.tick < end_tick) metadata.changes.push_back({change.tick, change.scene});
  }
  for (Mark mark : info.loaded.marks) {
    mark.tick = std::clamp(mark.tick, info.scanned.first_tick, info.scanned.last_tick);
    metadata.marks.push_back(std::move(mark));
  }
  return metadata;
}

// The names of a recording, whichever of them was given.
std::string csv_path_of(std::string path) {
  if (path.ends_with(kPartialEnding)) path.resize(path.size() - kPartialEnding.size());
  return path;
}

Failure check_names(const std::string& csv_path, const std::string& partial) {
  std::error_code ignored;
  if (!std::filesystem::exists(partial, ignored)) {
    const bool whole = std::filesystem::is_regular_file(csv_path, ignored);
    return usage_error(fmt::format("{}: there is no such file{}", shown(partial),
                                   whole ? "; the recording is whole already" : ""));
  }
  if (std::filesystem::exists(csv_path, ignored)) {
    return usage_error(
        fmt::format("{} is there already: move it away, or rename {} and its sidecar",
                    shown(csv_path), shown(partial)));
  }
  const std::string sidecar = sidecar_path_of(partial);
  if (!std::filesystem::exists(sidecar, ignored)) {
    return usage_error(
        fmt::format("{}: it is not there, and without it nobody knows the scene; "
                    "'hapticwall replay {}' shows the rows",
                    shown(sidecar), shown(partial)));
  }
  if (!may_replace_sidecar(sidecar_path_of(csv_path))) {
    return usage_error(
        fmt::format("{} is not a recording's sidecar and would be replaced: move it "
                    "away",
                    shown(sidecar_path_of(csv_path))));
  }
  return {};
}

}  // namespace

Result<Recovered> recover_recording(const std::string& path) {
  const std::string csv_path = csv_path_of(path);
  const std::string partial = csv_path + std::string(kPartialEnding);
  if (Failure failed = check_names(csv_path, partial)) return *failed;
  Result<AtomicFile> csv = AtomicFile::resume(csv_path);  // nobody writes it now
  if (!csv) return csv.error();
  csv->keep_partial();
  const auto reader = RecordingReader::open(partial);
  if (!reader) return reader.error();
  const RecordingInfo& info = (*reader)->info();
  if (!info.has_sidecar) return usage_error(info.sidecar_problem);
  const auto unknown_change = find_unknown_change(**reader);
  if (!unknown_change) return unknown_change.error();
  const Result<std::string> csv_sha256 = sha256_of(partial, info.scanned.end_offset);
  if (!csv_sha256) return csv_sha256.error();

  Recovered recovered{csv_path,
                      info.scanned.rows,
                      info.scanned.missing_rows,
                      csv->size() - info.scanned.end_offset,
                      {}};
  const RecordingMetadata metadata = metadata_of(info, *unknown_change);
  if (!metadata.repeatable) {
    recovered.notes.push_back("'run' will not repeat it: " + metadata.not_repeatable_because);
  }
  const RecordedRows counted{recovered.rows, metadata.dropped_rows, info.scanned.last_tick + 1,
                             *csv_sha256};
  const std::string text = sidecar_toml(info.loaded.scene, metadata, counted);
  if (Failure failed = write_sidecar(csv_path, text)) return *failed;
  if (Failure failed = csv->keep_only(info.scanned.end_offset)) return *failed;
  if (Failure failed = csv->commit()) return *failed;
  return recovered;
}

}  // namespace hapticwall::file
