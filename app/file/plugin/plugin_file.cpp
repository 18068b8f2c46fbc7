#include "app/file/plugin/plugin_file.h"

#include <deque>
#include <map>
#include <mutex>

#include "app/file/plugin/plugin_library.h"
#include "core/algorithm/plugin/include/hapticwall/environment.h"
#include "core/algorithm/plugin/plugin_list.h"
#include "core/environment/plugin/plugin_environment.h"

namespace hapticwall::file {
namespace {

constexpr const char* kExport = "hapticwall_plugin";
constexpr const char* kEnvironmentExport = "hapticwall_environment";

// Plug-in files by revision, indexed as in algorithms(). A plug-in registered by another program
// that uses this code has no file.
struct PluginFiles {
  std::mutex mutex;  // a recording is written while a file is loaded again
  std::map<std::size_t, std::deque<PluginFile>> all;
};
PluginFiles& plugin_files() {
  static PluginFiles files;
  return files;
}

// Files of environments, by index in environments(). The map changes before other threads start.
std::map<std::size_t, PluginFile>& environment_files() {
  static std::map<std::size_t, PluginFile> files;
  return files;
}

const hw_plugin& plugin_of(const void* symbol) { return *static_cast<const hw_plugin*>(symbol); }

}  // namespace

bool names_plugin(std::string_view text) { return text.find('/') != std::string_view::npos; }

const PluginFile* plugin_file(std::size_t algorithm, std::uint32_t revision) {
  const std::scoped_lock lock(plugin_files().mutex);
  const auto found = plugin_files().all.find(algorithm);
  if (found == plugin_files().all.end()) return nullptr;
  const std::deque<PluginFile>& files = found->second;
  return revision == 0 || revision > files.size() ? &files.back() : &files[revision - 1];
}

Result<std::size_t> load_plugin(const std::string& path) {
  for (const auto& [algorithm, files] : plugin_files().all) {
    if (files.front().path == path) return algorithm;
  }
  const Result<LibraryBytes> file = read_library(path);
  if (!file) return file.error();
  const Result<const void*> symbol = load_library(
      *file, kExport, [](const void* found) { return plugin_problem(plugin_of(found)); });
  if (!symbol) return symbol.error();
  const std::size_t index = add_plugin(plugin_of(*symbol));
  plugin_files().all[index].push_back({path, file->sha256});
  return index;
}

const PluginFile* environment_file(std::size_t environment) {
  const auto found = environment_files().find(environment);
  return found == environment_files().end() ? nullptr : &found->second;
}

Result<std::size_t> load_environment(const std::string& path) {
  for (const auto& [environment, file] : environment_files()) {
    if (file.path == path) return environment;
  }
  const Result<LibraryBytes> file = read_library(path);
  if (!file) return file.error();
  const Result<const void*> symbol = load_library(*file, kEnvironmentExport, [](const void* found) {
    return environment_problem(*static_cast<const hw_environment*>(found));
  });
  if (!symbol) return symbol.error();
  const std::size_t index = add_environment_plugin(*static_cast<const hw_environment*>(*symbol));
  environment_files()[index] = {path, file->sha256};
  return index;
}

Result<bool> reload_plugin(std::size_t algorithm) {
  const PluginFile newest = *plugin_file(algorithm);
  const Result<LibraryBytes> file = read_library(newest.path);
  if (!file) return file.error();
  if (file->sha256 == newest.sha256) return false;
  if (plugin_revision(algorithm) == kMaxPluginRevisions)
    return not_a_plugin(newest.path, "it was loaded too often; start the program again");
  const Result<const void*> symbol = load_library(*file, kExport, [=](const void* found) {
    return replacement_problem(plugin_of(found), algorithm);
  });
  if (!symbol) return symbol.error();
  {
    const std::scoped_lock lock(plugin_files().mutex);
    plugin_files().all.at(algorithm).push_back({newest.path, file->sha256});
  }
  replace_plugin(algorithm, plugin_of(*symbol));
  return true;
}

}  // namespace hapticwall::file
