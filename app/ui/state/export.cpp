#include "app/ui/state/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "app/ui/state/comparing.h"

namespace hapticwall::ui {
namespace {

// Ticks of the range that were dropped on their way to the plots.
std::uint64_t missing_ticks(const draw::SampleHistory& history, draw::IndexRange range) {
  const double ticks =
      history.value(&Sample::tick, range.last - 1) - history.value(&Sample::tick, range.first);
  return static_cast<std::uint64_t>(ticks) + 1 - range.count();
}

file::RecordingMetadata metadata_of(const draw::SampleHistory& history, draw::IndexRange range,
                                    const ExportSource& source) {
  file::RecordingMetadata metadata;
  metadata.device = source.device;
  metadata.realtime_status = "exported from the window";
  metadata.first_tick = static_cast<std::uint64_t>(history.value(&Sample::tick, range.first));
  metadata.dropped_rows = missing_ticks(history, range);
  metadata.repeatable = false;
  metadata.not_repeatable_because = "it is a range of a session, exported from its plots";
  return metadata;
}

}  // namespace

Result<std::uint64_t> export_csv(const draw::SampleHistory& history, draw::IndexRange range,
                                 const ExportSource& source, const std::string& csv_path) {
  if (range.count() == 0)
    return Error{ErrorKind::kUsage, "nothing to export: no sample in the visible range"};
  auto writer = file::RecordingWriter::create(csv_path, file::csv_columns(source.simulated));
  if (!writer) return writer.error();
  for (std::size_t i = range.first; i < range.last; ++i) {
    if (Failure failure = (*writer)->append({{history.sample(i)}})) return *failure;
  }
  if (Failure failure = (*writer)->finish(source.scene, metadata_of(history, range, source)))
    return *failure;
  return (*writer)->rows();
}

std::string plain_file_name(std::string name) {
  constexpr std::size_t kMaxBytes = 200;  // bytes; close to the limit of file systems
  name.resize(std::min(name.size(), kMaxBytes));
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (!plain && c != '-' && c != '_' && c != '.') c = '-';
  }
  if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
  return name;
}

std::string export_name(const Scene& scene, double from_s, double to_s) {
  return plain_file_name(fmt::format("{}-{}-{:.3f}-{:.3f}s", scene.name,
                                     algorithm_name(scene.algorithm), from_s, to_s));
}

std::string unused_base(const std::string& folder, const std::string& name,
                        std::initializer_list<std::string> endings) {
  const std::string stem = (std::filesystem::path(folder) / name).string();
  std::string base = stem;
  const auto taken = [&](const std::string& ending) {
    std::error_code ignored;
    return std::filesystem::exists(base + ending, ignored);
  };
  for (int number = 2; std::ranges::any_of(endings, taken); ++number)
    base = fmt::format("{}-{}", stem, number);
  return base;
}

std::string unused_path(const std::string& folder, const std::string& name,
                        const std::string& ending) {
  return unused_base(folder, name, {ending}) + ending;
}

void ExportJob::start(const draw::SampleHistory& history, draw::IndexRange range,
                      const ExportSource& source, const std::string& csv_path) {
  auto copy = std::make_shared<const draw::SampleHistory>(history);
  future_ = std::async(std::launch::async, [copy = std::move(copy), range, source, csv_path] {
              return Outcome{csv_path, export_csv(*copy, range, source, csv_path)};
            }).share();
}

std::optional<ExportJob::Outcome> ExportJob::take() {
  if (!running() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return std::nullopt;
  return std::exchange(future_, {}).get();
}

}  // namespace hapticwall::ui
