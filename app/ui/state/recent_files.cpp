#include "app/ui/state/recent_files.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/file/recording/recording_reader.h"
#include "app/file/scene/scene_file.h"
#include "app/ui/state/scene_state.h"

namespace hapticwall::ui {
namespace {

std::string whole_path(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return error ? path : whole.lexically_normal().string();
}

// Tells why a file does not open, and forgets it.
void refuse_file(SceneState& state, Toasts& toasts, const std::string& path, const Error& error) {
  tell(toasts, error);
  std::erase(state.recent, path);
}

}  // namespace

void remember_recent(std::vector<std::string>& recent, const std::string& path) {
  const std::string whole = whole_path(path);
  std::erase(recent, whole);
  recent.insert(recent.begin(), whole);
  recent.resize(std::min(recent.size(), kMaxRecentFiles));
}

void open_file(SceneState& state, Toasts& toasts, const std::string& path) {
  const std::string whole = whole_path(path);
  std::error_code ignored;
  if (!file::is_recording(whole)) {
    Result<file::LoadedScene> loaded = file::load_scene(whole);
    if (!loaded) return refuse_file(state, toasts, whole, loaded.error());
    state.wanted = WantedScene{std::move(loaded->scene), true};
  } else if (std::filesystem::is_regular_file(whole, ignored)) {
    state.wanted_recording = whole;
  } else {
    return refuse_file(state, toasts, whole,
                       {ErrorKind::kFile, whole + ": there is no such recording"});
  }
  remember_recent(state.recent, whole);
}

}  // namespace hapticwall::ui
