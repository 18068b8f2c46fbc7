#include "app/ui/window/settings_file.h"

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

constexpr double kLookS = 0.25;  // interval between two checks for changes

// Copies a file that the next save replaces.
void complain(UiState& state, const std::string& path, const std::string& problem, bool replaced) {
  const std::string copy = path + ".broken";
  std::error_code error;
  const bool copied =
      replaced && fs::copy_file(path, copy, fs::copy_options::overwrite_existing, error);
  state.toasts.tell(
      MessageKind::kProblem,
      copied ? fmt::format("settings: {}; a copy of the file is kept as {}", problem, copy)
             : fmt::format("settings: {}", problem));
}

}  // namespace

void SettingsFile::load(UiState& state) {
  saved_ = resting_ = settings_text(state);
  std::error_code error;
  if (path_.empty()) return;
  const bool old = !fs::exists(path_, error);
  const std::string path = old ? fs::path(path_).replace_extension(".toml").string() : path_;
  if (!fs::exists(path, error)) return;
  const Result<std::string> text = file::read_small_file(path, "settings file", kMaxSettingsBytes);
  const Result<std::vector<std::string>> problems =
      !text ? Result<std::vector<std::string>>(text.error())
            : (old ? apply_old_settings : apply_settings)(*text, path, state);
  if (!problems) {
    complain(state, path, problems.error().message, !old);
  } else if (!problems->empty()) {
    complain(state, path, fmt::format("{}: {}", path, fmt::join(*problems, "; ")), !old);
  }
  resting_ = settings_text(state);
  // Empty, so that the next save replaces the file, or writes it beside the old one.
  saved_ = problems && problems->empty() && !old ? resting_ : "";
}

void SettingsFile::pass(UiState& state, double seconds) {
  if (path_.empty()) return;
  unseen_s_ += seconds;
  if (unseen_s_ < kLookS) return;
  const double looked_after_s = std::exchange(unseen_s_, 0.0);
  std::string now = settings_text(state);
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
  const std::string now = settings_text(state);
  if (now != saved_) write(state, now);
}

void SettingsFile::write(UiState& state, const std::string& text) {
  Failure failure = file::make_folder_of(path_);
  if (!failure) failure = file::write_file(path_, text);
  saved_ = text;  // prevents a new attempt at every frame
  if (failure && !std::exchange(told_, true))
    state.toasts.tell(MessageKind::kProblem, "settings are not kept: " + failure->message);
}

}  // namespace hapticwall::ui
