#include "app/file/recording/recording_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/disk/sha256.h"
#include "app/file/recording/recovery.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/hand_file.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16U;

Failure check_sidecar(const std::string& csv_path, const std::string& remedy) {
  const std::string sidecar_path = sidecar_path_of(csv_path);
  const std::string obstacle = sidecar_obstacle(sidecar_path, kRecordingTable);
  if (obstacle.empty()) return {};
  return file_error(fmt::format("{}: cannot be recorded: its sidecar {} would replace {}; {}",
                                shown(csv_path), shown(sidecar_path), obstacle, remedy));
}

bool has_rows(const std::string& partial_csv) {
  std::ifstream in(partial_csv);
  std::string header;
  return std::getline(in, header) && in.peek() != std::ifstream::traits_type::eof();
}

// An earlier recording under this name was cut off and can still be recovered.
bool can_be_finished(const std::string& csv_path) {
  const std::string partial = partial_of(csv_path);
  std::error_code ignored;
  return has_rows(partial) && (std::filesystem::exists(sidecar_path_of(partial), ignored) ||
                               lacks_only_its_name(csv_path));
}

class CsvRecordingWriter final : public RecordingWriter {
 public:
  CsvRecordingWriter(AtomicFile csv, CsvColumns columns)
      : csv_(std::move(csv)),
        sidecar_path_(sidecar_path_of(csv_.path())),
        columns_(std::move(columns)) {
    buffer_.reserve(kBufferBytes + kMaxCsvLineBytes + 1);
    buffer_ = csv_header(columns_) + '\n';
  }

  CsvRecordingWriter(const CsvRecordingWriter&) = delete;
  CsvRecordingWriter& operator=(const CsvRecordingWriter&) = delete;
  ~CsvRecordingWriter() override {
    if (rows_ == 0) std::remove(partial_sidecar().c_str());
  }

  Failure note(const Scene& scene, const RecordingMetadata& metadata) override {
    RecordedRows recorded;
    recorded.finished = false;
    recorded.session_ticks = metadata.session_ticks.value_or(0);
    return write_file(partial_sidecar(),
                      sidecar_toml(beside(scene, csv_.path()), metadata, recorded));
  }

  Failure append(const Tick& tick) override {
    if (failed_) return failed_;
    if (!is_finite(tick)) {
      ++skipped_rows_;
      return {};
    }
    dropped_rows_ += std::exchange(skipped_rows_, 0);
    append_csv_row(buffer_, tick, columns_);
    if (rows_++ == 0) csv_.keep_partial();
    session_ticks_ = std::max(session_ticks_, tick.x().tick + 1);
    return buffer_.size() < kBufferBytes ? Failure{} : flush();
  }

  Failure flush() override {
    if (failed_) return failed_;
    failed_ = csv_.write(buffer_);
    digest_.update(buffer_);
    buffer_.clear();
    return failed_;
  }

  Failure sync() override {
    if (!flush()) failed_ = csv_.secure();
    return failed_;
  }

  // The CSV gets its name last, after its sidecar.
  Failure finish(const Scene& scene, const RecordingMetadata& metadata) override {
    if (Failure failed = flush()) return failed;
    if (Failure failed = csv_.sync()) return failed;
    const RecordedRows recorded{rows_, metadata.dropped_rows + dropped_rows_,
                                metadata.session_ticks.value_or(session_ticks_), digest_.finish()};
    const std::string text = sidecar_toml(beside(scene, csv_.path()), metadata, recorded);
    if (Failure refused = check_sidecar(csv_.path(), recovery_remedy())) return refused;
    if (Failure failed = write_sidecar(csv_.path(), text)) return failed;
    return csv_.commit();
  }

  [[nodiscard]] std::uint64_t rows() const override { return rows_; }
  [[nodiscard]] const std::string& csv_path() const override { return csv_.path(); }
  [[nodiscard]] const std::string& sidecar_path() const override { return sidecar_path_; }

 private:
  // Advice for the case that another file took the sidecar's name during the recording.
  [[nodiscard]] std::string recovery_remedy() const {
    return fmt::format(
        "its rows are in {}; move that file, then 'hapticwall recover {}' finishes it",
        shown(csv_.partial_path()), shown(csv_.path()));
  }
  [[nodiscard]] std::string partial_sidecar() const { return partial_of(sidecar_path_); }

  AtomicFile csv_;
  std::string sidecar_path_;
  CsvColumns columns_;
  Sha256 digest_;
  std::string buffer_;
  Failure failed_;
  std::uint64_t rows_ = 0;
  std::uint64_t skipped_rows_ = 0;  // rows that are not finite, since the last finite one
  std::uint64_t dropped_rows_ = 0;  // holes
  std::uint64_t session_ticks_ = 0;
};

}  // namespace

std::array<std::optional<std::uint64_t>, kMaxAxes> divergence_of(const RunSummary& summary) {
  std::array<std::optional<std::uint64_t>, kMaxAxes> ticks;
  for (std::size_t i = 0; i < summary.size(); ++i) ticks.at(i) = summary[i].diverged_at_tick;
  return ticks;
}

RecordingMetadata headless_metadata(const LoadedScene& loaded, std::uint64_t ticks,
                                    const RunSummary& summary) {
  RecordingMetadata metadata;
  metadata.device = "simulator";
  metadata.realtime_status = "not in real time: as fast as the machine can";
  metadata.first_tick = loaded.first_recorded_tick;
  metadata.session_ticks = ticks;
  metadata.diverged_at_tick = divergence_of(summary);
  metadata.changes = loaded.changes;
  return metadata;
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::string& path,
                                                                 CsvColumns columns) {
  const Result<std::string> place = replaceable_path(path);
  if (!place) return place.error();
  const std::string& csv_path = *place;
  if (Failure refused = check_sidecar(csv_path, "choose another name")) return *refused;
  Result<AtomicFile> csv = AtomicFile::resume(csv_path);
  if (!csv) return csv.error();
  if (can_be_finished(csv_path)) {
    csv->keep_partial();
    return file_error(
        fmt::format("{} has rows of a recording that was cut off: 'hapticwall recover {}' "
                    "finishes it; or remove it",
                    shown(csv->partial_path()), shown(csv_path)));
  }
  if (csv->size() > 0) {
    if (Failure failed = csv->keep_only(0)) return *failed;
  }
  return std::unique_ptr<RecordingWriter>(
      std::make_unique<CsvRecordingWriter>(std::move(*csv), std::move(columns)));
}

}  // namespace hapticwall::file
