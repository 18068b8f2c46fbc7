#include "app/ui/state/recent_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/file/recording/recording_reader.h"
#include "app/file/scene/scene_file.h"

namespace hapticwall::ui {
namespace {

std::string whole_path(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return error ? path : whole.lexically_normal().string();
}

void open_scene(UiState& state, const std::string& path) {
  Result<file::LoadedScene> loaded = file::load_scene(path);
  if (!loaded) {
    tell(state, MessageKind::kProblem, loaded.error().message);
    std::erase(state.persisted.recent, path);
    return;
  }
  state.transient.wanted_scene = WantedScene{std::move(loaded->scene), true};
  remember_recent(state.persisted.recent, path);
}

}  // namespace

void remember_recent(std::vector<std::string>& recent, const std::string& path) {
  const std::string whole = whole_path(path);
  std::erase(recent, whole);
  recent.insert(recent.begin(), whole);
  recent.resize(std::min(recent.size(), kMaxRecentFiles));
}

void open_file(UiState& state, const std::string& path) {
  const std::string whole = whole_path(path);
  if (!file::is_recording(whole)) {
    open_scene(state, whole);
    return;
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(whole, error)) {
    tell(state, MessageKind::kProblem, whole + ": there is no such recording");
    std::erase(state.persisted.recent, whole);
    return;
  }
  state.transient.wanted_recording = whole;
  remember_recent(state.persisted.recent, whole);
}

}  // namespace hapticwall::ui
