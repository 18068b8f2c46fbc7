#include "app/ui/state/settings_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/disk/small_file.h"
#include "app/file/disk/user_folders.h"

namespace hapticwall::ui {
namespace {

namespace fs = std::filesystem;

constexpr double kLookS = 0.25;  // between two looks for changes

void keep_broken(UiState& state, const std::string& path, const std::string& problem) {
  const std::string copy = path + ".broken";
  std::error_code error;
  fs::copy_file(path, copy, fs::copy_options::overwrite_existing, error);
  tell(state, MessageKind::kProblem,
       error ? fmt::format("settings: {}", problem)
             : fmt::format("settings: {}; a copy of the file is kept as {}", problem, copy));
}

}  // namespace

void SettingsFile::load(UiState& state) {
  saved_ = resting_ = settings_of(state);
  std::error_code error;
  if (path_.empty() || !fs::exists(path_, error)) return;
  const Result<std::string> text =
      file::read_small_file(path_, "settings file", file::kMaxSettingsBytes);
  const Result<file::Settings> settings =
      text ? file::parse_settings(*text, path_) : Result<file::Settings>(text.error());
  if (!settings) {
    keep_broken(state, path_, settings.error().message);
    saved_.clear();  // so that the next save replaces the file
    return;
  }
  const std::vector<std::string> problems = apply_settings(*settings, state);
  if (!problems.empty())
    keep_broken(state, path_, fmt::format("{}: {}", path_, fmt::join(problems, "; ")));
  saved_ = resting_ = settings_of(state);
  if (!problems.empty()) saved_.clear();
}

void SettingsFile::pass(UiState& state, double seconds) {
  if (path_.empty()) return;
  unseen_s_ += seconds;
  if (unseen_s_ < kLookS) return;
  const double looked_after_s = std::exchange(unseen_s_, 0.0);
  file::Settings now = settings_of(state);
  if (now != resting_) {
    resting_ = std::move(now);
    rested_s_ = 0.0;
    return;
  }
  rested_s_ += looked_after_s;
  if (rested_s_ >= kSettingsRestS && now != saved_) write(state, now);
}

void SettingsFile::save(UiState& state) {
  if (path_.empty()) return;
  const file::Settings now = settings_of(state);
  if (now != saved_) write(state, now);
}

void SettingsFile::write(UiState& state, const file::Settings& settings) {
  Failure failure = file::make_folder_of(path_);
  if (!failure) failure = file::write_file(path_, file::settings_text(settings));
  saved_ = settings;  // prevents a new attempt at every frame
  if (failure && !std::exchange(told_, true))
    tell(state, MessageKind::kProblem, "settings are not kept: " + failure->message);
}

}  // namespace hapticwall::ui
