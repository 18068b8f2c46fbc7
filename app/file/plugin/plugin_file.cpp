#include "app/file/plugin/plugin_file.h"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "core/stabiliser/plugin/include/hapticwall/plugin.h"
#include "core/stabiliser/plugin/plugin_list.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxPluginBytes = std::size_t{1} << 28U;
constexpr const char* kExport = "hapticwall_plugin";

// The files of each plug-in by revision, by their index in algorithms(). A plug-in of another
// program that uses this code has none.
struct PluginFiles {
  std::mutex mutex;  // a recording is written while a file is loaded again
  std::map<std::size_t, std::deque<PluginFile>> all;
};
PluginFiles& plugin_files() {
  static PluginFiles files;
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

// Whether the file ends before its segments or its table of sections, as one that is being written.
// The loader would crash.
bool is_cut_off(std::string_view bytes) {
  Elf64_Ehdr header;
  if (bytes.size() < sizeof header) return false;  // the loader says what it is
  std::memcpy(&header, bytes.data(), sizeof header);
  if (!bytes.starts_with(std::string_view(ELFMAG, SELFMAG))) return false;
  const auto beyond = [&](std::uint64_t offset, std::uint64_t size) {
    return size > bytes.size() || offset > bytes.size() - size;
  };
  const std::size_t segment_bytes = std::size_t{header.e_phnum} * sizeof(Elf64_Phdr);
  if (beyond(header.e_phoff, segment_bytes) ||
      beyond(header.e_shoff, std::size_t{header.e_shnum} * header.e_shentsize)) {
    return true;
  }
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment;
    std::memcpy(&segment, bytes.data() + header.e_phoff + i * sizeof segment, sizeof segment);
    if (segment.p_type != PT_NULL && beyond(segment.p_offset, segment.p_filesz)) return true;
  }
  return false;
}

using Check = std::function<std::string(const hw_plugin& plugin)>;

Result<const hw_plugin*> plugin_in(const std::string& path, void* library, const Check& check) {
  if (library == nullptr) return not_a_plugin(path, loader_problem());
  const auto* const plugin = static_cast<const hw_plugin*>(dlsym(library, kExport));
  if (plugin == nullptr) return not_a_plugin(path, fmt::format("it exports no {}", kExport));
  const std::string problem = check(*plugin);
  if (!problem.empty()) return not_a_plugin(path, problem);
  return plugin;
}

// A plug-in that `check` has nothing against. Its library stays loaded for ever.
Result<const hw_plugin*> load_bytes(const std::string& path, std::string_view bytes,
                                    const Check& check) {
  if (is_cut_off(bytes)) return not_a_plugin(path, "the file is not whole");
  const int descriptor = copied_to_memory(bytes);
  if (descriptor < 0) return cannot_be_read(path, errno);
  const std::string copy = fmt::format("/proc/self/fd/{}", descriptor);
  void* const library = dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL);
  Result<const hw_plugin*> plugin = plugin_in(path, library, check);
  if (plugin) return plugin;
  if (library != nullptr) dlclose(library);
  close(descriptor);
  return plugin;
}

struct LibraryBytes {
  std::string bytes;
  std::string sha256;
};

Result<LibraryBytes> read_library(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    return not_a_plugin(path, "not a file");
  Result<std::string> bytes = read_small_file(path, "plug-in", kMaxPluginBytes);
  if (!bytes) return bytes.error();
  Sha256 digest;
  digest.update(*bytes);
  return LibraryBytes{std::move(*bytes), digest.finish()};
}

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
  Result<LibraryBytes> read = read_library(path);
  if (!read) return read.error();
  const Result<const hw_plugin*> plugin = load_bytes(path, read->bytes, plugin_problem);
  if (!plugin) return plugin.error();
  const std::size_t index = add_plugin(**plugin);
  plugin_files().all[index].push_back({path, std::move(read->sha256)});
  return index;
}

Result<bool> reload_plugin(std::size_t algorithm) {
  const PluginFile newest = *plugin_file(algorithm);
  Result<LibraryBytes> read = read_library(newest.path);
  if (!read) return read.error();
  if (read->sha256 == newest.sha256) return false;
  if (plugin_revision(algorithm) == kMaxPluginRevisions)
    return not_a_plugin(newest.path, "it was loaded too often; start the program again");
  const Result<const hw_plugin*> plugin = load_bytes(
      newest.path, read->bytes,
      [algorithm](const hw_plugin& newer) { return replacement_problem(newer, algorithm); });
  if (!plugin) return plugin.error();
  {
    const std::scoped_lock lock(plugin_files().mutex);
    plugin_files().all.at(algorithm).push_back({newest.path, read->sha256});
  }
  replace_plugin(algorithm, **plugin);
  return true;
}

}  // namespace hapticwall::file
