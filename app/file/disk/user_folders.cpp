#include "app/file/disk/user_folders.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOff = "off";

// By the specification, a relative path counts as not set.
std::optional<fs::path> absolute_folder(const Environment& environment, const char* name) {
  const std::optional<std::string> value = environment(name);
  if (!value || !fs::path(*value).is_absolute()) return std::nullopt;
  return fs::path(*value);
}

}  // namespace

std::optional<std::string> process_environment(const std::string& name) {
  // Called at the start of the program, before other threads exist.
  const char* value = std::getenv(name.c_str());  // NOLINT(concurrency-mt-unsafe)
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

std::string settings_path(const Environment& environment) {
  if (const auto named = environment("HAPTICWALL_SETTINGS"); named && !named->empty())
    return *named == kOff ? std::string() : *named;
  std::optional<fs::path> folder = absolute_folder(environment, "XDG_CONFIG_HOME");
  if (!folder) {
    folder = absolute_folder(environment, "HOME");
    if (!folder) return {};
    *folder /= ".config";
  }
  return (*folder / "hapticwall" / "settings.json").string();
}

Failure make_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (folder.empty() || fs::is_directory(folder, error)) return std::nullopt;
  if (fs::create_directories(folder, error)) {
    fs::permissions(folder, fs::perms::owner_all, error);
    return std::nullopt;
  }
  return file_error(
      fmt::format("{}: cannot be created: {}", shown(folder.string()), error.message()));
}

}  // namespace hapticwall::file
