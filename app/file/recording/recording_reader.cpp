#include "app/file/recording/recording_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/recording/recording_rows.h"
#include "app/file/recording/sidecar.h"
#include "app/file/scene/table_reader.h"
#include "app/file/text/text.h"
#include "core/scene_keys.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;

// Returns fewer bytes than asked for only at the end of the file; -1 on failure.
ssize_t read_fully(int descriptor, char* out, std::size_t size, std::uint64_t offset) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count =
        pread(descriptor, out + done, size - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return static_cast<ssize_t>(done);
}

// The text of a key of [recording]; empty if there is none.
std::string recorded(const toml::table& root, std::string_view key) {
  constexpr std::size_t kMaxTextBytes = 500;
  return shown(root["recording"][key].value_or(std::string_view()), kMaxTextBytes);
}

}  // namespace

bool is_recording(std::string_view path) {
  return path.ends_with(".csv") || path.ends_with(".csv.partial");
}

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::string& csv_path,
                                                               const ReadProgress& progress) {
  const int descriptor = ::open(csv_path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return cannot_be_read(csv_path, errno);
  std::unique_ptr<RecordingReader> reader(new RecordingReader(descriptor));
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return cannot_be_read(csv_path, errno);
  if (!S_ISREG(status.st_mode)) {
    return usage_error(shown(csv_path) + ": not a recording: not a file");
  }
  reader->info_.csv_path = csv_path;
  reader->read_sidecar();
  if (Failure failed = reader->scan(progress)) return *std::move(failed);
  return reader;
}

RecordingReader::~RecordingReader() { close(descriptor_); }

// The rows are shown even if the sidecar is wrong.
void RecordingReader::read_sidecar() {
  const std::string& csv_path = info_.csv_path;
  std::vector<std::string>& notes = info_.notes;
  info_.loaded.scene.name = shown(std::filesystem::path(csv_path).stem().string());
  const bool partial = csv_path.ends_with(kPartialEnding);
  if (partial) {
    tolerance_ = {.holes = true, .cut_off = true};
    notes.emplace_back("never finished: 'hapticwall recover' finishes it");
  }
  const std::string path = find_sidecar(csv_path);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    notes.push_back(
        fmt::format("no sidecar {}: scene, walls and algorithm are not known", shown(path)));
    return;
  }
  const Result<std::string> text = read_small_file(path, "sidecar", kMaxSidecarBytes);
  Result<LoadedScene> loaded = text ? parse_scene(*text, path) : text.error();
  if (!loaded) {
    info_.sidecar_problem = loaded.error().message;
    notes.push_back("shown without its sidecar: " + info_.sidecar_problem);
    return;
  }
  const toml::table root = parse_toml(*text, path);  // parse_scene() has accepted it
  if (!root["recording"].is_table()) {
    info_.sidecar_problem = shown(path) + " has no [recording]: not this recording's sidecar";
    notes.push_back(info_.sidecar_problem);
    return;
  }
  info_.has_sidecar = true;
  info_.loaded = std::move(*loaded);
  info_.device = recorded(root, "device");
  info_.realtime = recorded(root, "realtime");
  info_.start_time = recorded(root, "start_time");
  if (info_.loaded.edited) notes.emplace_back(kEditedSidecar);
  if (!info_.loaded.changed_plugin.empty())
    notes.push_back(fmt::format("its plug-in {} was changed since (SHA-256 differs)",
                                shown(info_.loaded.changed_plugin)));
  tolerance_.holes = partial || !root["recording"]["complete"].value_or(true);
}

Failure RecordingReader::scan(const ReadProgress& progress) {
  RecordingScan scan(info_.csv_path, tolerance_);
  const std::string& claimed_sha256 = info_.loaded.csv_sha256;
  Sha256 digest;
  text_.resize(kPieceBytes);
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) return cannot_be_read(info_.csv_path, errno);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  for (std::uint64_t offset = 0; offset < size;) {
    const std::size_t wanted = std::min<std::uint64_t>(kPieceBytes, size - offset);
    const ssize_t count = read_fully(descriptor_, text_.data(), wanted, offset);
    if (count < 0) return cannot_be_read(info_.csv_path, errno);
    if (count == 0) return changed();
    const std::string_view piece(text_.data(), static_cast<std::size_t>(count));
    if (!claimed_sha256.empty()) digest.update(piece);
    if (Failure failed = scan.take(piece)) return failed;
    offset += piece.size();
    if (progress && !progress(static_cast<double>(offset) / static_cast<double>(size))) {
      return usage_error(shown(info_.csv_path) + ": reading was ended early");
    }
  }
  Result<ScannedRows> scanned = scan.finish();
  if (!scanned) return scanned.error();
  if (!claimed_sha256.empty() && digest.finish() != claimed_sha256) {
    info_.notes.emplace_back(
        "its rows are not those that its sidecar was written for (the SHA-256 differs)");
  }
  take_over(std::move(*scanned));
  return {};
}

void RecordingReader::take_over(ScannedRows scanned) {
  if (scanned.missing_rows > 0) {
    info_.notes.push_back(fmt::format("incomplete: {} rows are missing", scanned.missing_rows));
  }
  if (scanned.cut_off) info_.notes.emplace_back("its last line is cut off and left out");
  if (!info_.has_sidecar && scanned.rate_hz &&
      number_keys<SamplingSettings>().front().range.contains(*scanned.rate_hz)) {
    info_.loaded.scene.sampling.rate_hz = *scanned.rate_hz;
  }
  info_.rate_hz = info_.loaded.scene.sampling.rate_hz;
  info_.scanned = std::move(scanned);
}

Error RecordingReader::changed() const {
  return usage_error(shown(info_.csv_path) + ": changed while it was read");
}

std::uint32_t RecordingReader::generation_at(std::uint64_t tick) const {
  const std::vector<ScheduledChange>& changes = info_.loaded.changes;
  const auto next = std::upper_bound(
      changes.begin(), changes.end(), tick,
      [](std::uint64_t value, const ScheduledChange& change) { return value < change.tick; });
  return static_cast<std::uint32_t>(next - changes.begin());
}

Failure RecordingReader::load_block(std::uint64_t block) {
  if (block == loaded_block_) return {};
  loaded_block_ = kNoBlock;
  const std::vector<RowBlock>& blocks = info_.scanned.blocks;
  const std::uint64_t begin = blocks[block].offset;
  const std::uint64_t end =
      block + 1 < blocks.size() ? blocks[block + 1].offset : info_.scanned.end_offset;
  text_.resize(end - begin);
  const ssize_t count = read_fully(descriptor_, text_.data(), text_.size(), begin);
  if (count < 0) return cannot_be_read(info_.csv_path, errno);
  if (static_cast<std::size_t>(count) < text_.size()) return changed();
  if (!parse_block(std::min(kRowsPerBlock, rows() - block * kRowsPerBlock))) return changed();
  loaded_block_ = block;
  return {};
}

bool RecordingReader::parse_block(std::uint64_t wanted_rows) {
  ticks_.clear();
  for (std::string_view rest = text_; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return false;
    Tick& tick = ticks_.emplace_back();
    if (parse_csv_row(rest.substr(0, end), info_.scanned.columns, tick)) return false;
    const std::uint32_t generation = generation_at(tick.x().tick);
    for (Sample& sample : tick.in_use()) sample.generation = generation;
    rest.remove_prefix(end + 1);
  }
  return ticks_.size() == wanted_rows;
}

Result<std::size_t> RecordingReader::read(std::uint64_t first_row, std::span<Tick> out) {
  std::size_t done = 0;
  while (done < out.size() && first_row + done < rows()) {
    const std::uint64_t row = first_row + done;
    if (Failure failed = load_block(row / kRowsPerBlock)) return *std::move(failed);
    const std::size_t from = row % kRowsPerBlock;
    const std::size_t count = std::min(ticks_.size() - from, out.size() - done);
    std::ranges::copy(std::span(ticks_).subspan(from, count), out.subspan(done).begin());
    done += count;
  }
  return done;
}

Result<std::uint64_t> RecordingReader::row_at(std::uint64_t tick) {
  const std::vector<RowBlock>& blocks = info_.scanned.blocks;
  const auto behind = std::upper_bound(
      blocks.begin(), blocks.end(), tick,
      [](std::uint64_t value, const RowBlock& block) { return value < block.first_tick; });
  if (behind == blocks.begin()) return std::uint64_t{0};
  const auto block = static_cast<std::uint64_t>(behind - blocks.begin() - 1);
  if (Failure failed = load_block(block)) return *std::move(failed);
  const auto found =
      std::lower_bound(ticks_.begin(), ticks_.end(), tick,
                       [](const Tick& row, std::uint64_t value) { return row.x().tick < value; });
  return block * kRowsPerBlock + static_cast<std::uint64_t>(found - ticks_.begin());
}

}  // namespace hapticwall::file
