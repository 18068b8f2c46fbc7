#include "app/file/plugin/plugin_file.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>

#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "core/stabiliser/plugin/include/hapticwall/plugin.h"
#include "core/stabiliser/plugin/plugin_list.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxPluginBytes = std::size_t{1} << 28U;
constexpr const char* kExport = "hapticwall_plugin";

// By their index in algorithms(). A plug-in of another program that uses this code has no file.
std::map<std::size_t, PluginFile>& plugin_files() {
  static std::map<std::size_t, PluginFile> files;
  return files;
}

Error not_a_plugin(const std::string& path, std::string_view problem) {
  return usage_error(fmt::format("{}: no plug-in: {}", shown(path), problem));
}

bool write_fully(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

// A copy in memory, because a linker that writes over a loaded library would crash the program. It
// stays open: the loader takes two files of the same name for one.
int copied_to_memory(std::string_view bytes) {
  const int descriptor = memfd_create("hapticwall-plugin", MFD_CLOEXEC);
  if (descriptor < 0 || write_fully(descriptor, bytes)) return descriptor;
  const int code = errno;
  close(descriptor);
  errno = code;
  return -1;
}

// dlerror() names the copy; the reason stands behind it.
std::string loader_problem() {
  const char* const text = dlerror();
  const std::string problem = text == nullptr ? "it cannot be loaded" : text;
  const std::size_t colon = problem.starts_with("/proc/") ? problem.find(": ") : std::string::npos;
  return shown(colon == std::string::npos ? problem : problem.substr(colon + 2));
}

Result<std::size_t> add_library(const std::string& path, void* library) {
  const auto* const plugin = static_cast<const hw_plugin*>(dlsym(library, kExport));
  if (plugin == nullptr) return not_a_plugin(path, fmt::format("it exports no {}", kExport));
  const std::string problem = plugin_problem(*plugin);
  if (!problem.empty()) return not_a_plugin(path, problem);
  return add_plugin(*plugin);
}

Result<std::size_t> load_bytes(const std::string& path, std::string_view bytes) {
  const int descriptor = copied_to_memory(bytes);
  if (descriptor < 0) return cannot_be_read(path, errno);
  const std::string copy = fmt::format("/proc/self/fd/{}", descriptor);
  void* const library = dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL);
  Result<std::size_t> index =
      library == nullptr ? not_a_plugin(path, loader_problem()) : add_library(path, library);
  if (index) return index;
  if (library != nullptr) dlclose(library);
  close(descriptor);
  return index;
}

}  // namespace

bool names_plugin(std::string_view text) { return text.find('/') != std::string_view::npos; }

const PluginFile* plugin_file(std::size_t algorithm) {
  const auto found = plugin_files().find(algorithm);
  return found == plugin_files().end() ? nullptr : &found->second;
}

Result<std::size_t> load_plugin(const std::string& path) {
  for (const auto& [algorithm, plugin] : plugin_files()) {
    if (plugin.path == path) return algorithm;
  }
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return not_a_plugin(path, "not a file");
  const Result<std::string> bytes = read_small_file(path, "plug-in", kMaxPluginBytes);
  if (!bytes) return bytes.error();
  Sha256 digest;
  digest.update(*bytes);
  Result<std::size_t> index = load_bytes(path, *bytes);
  if (index) plugin_files().insert({*index, {path, digest.finish()}});
  return index;
}

}  // namespace hapticwall::file
