#include "app/file/plugin/plugin_library.h"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "app/file/disk/sha256.h"
#include "app/file/disk/small_file.h"
#include "app/file/text/text.h"
#include "core/algorithm/plugin/library_call.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kMaxPluginBytes = std::size_t{1} << 28U;

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

// dlerror() begins with the name of the copy; the reason stands behind it.
std::string loader_problem() {
  const char* const text = dlerror();  // NOLINT(concurrency-mt-unsafe): each thread has its own
  const std::string problem = text == nullptr ? "it cannot be loaded" : text;
  const std::size_t colon = problem.starts_with("/proc/") ? problem.find(": ") : std::string::npos;
  return shown(colon == std::string::npos ? problem : problem.substr(colon + 2));
}

// True if the file ends before its segments or its table of sections, as one that is being written.
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

// True if another user than this one and root may change the file, or the names in the folder.
bool others_can_write(const struct stat& status) {
  const uid_t user = geteuid();
  if (status.st_uid != user && status.st_uid != 0) return true;
  if (S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0) return false;
  // An ordinary user often has a group of one member.
  const bool counts = user == 0 && status.st_gid != 0;
  return (status.st_mode & (counts ? S_IWGRP | S_IWOTH : S_IWOTH)) != 0;
}

// Why this user must not run the code of the open file, or "".
std::string trust_problem(int descriptor) {
  struct stat file {};
  struct stat folder {};
  std::error_code failed;
  const auto path =
      std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), failed);
  if (fstat(descriptor, &file) != 0 || failed || stat(path.parent_path().c_str(), &folder) != 0)
    return "its owner and folder cannot be read";
  if (others_can_write(file)) return "another user can write it; copy it to a folder of yours";
  if (!others_can_write(folder)) return "";
  return "another user can write its folder; copy it to a folder of yours";
}

// Reason why the file is no usable library, or "".
std::string problem_in(void* library, const char* symbol, const ProblemOf& problem_of) {
  if (library == nullptr) return loader_problem();
  const void* const found = dlsym(library, symbol);
  return found == nullptr ? fmt::format("it exports no {}", symbol) : problem_of(found);
}

}  // namespace

Error not_a_plugin(const std::string& path, std::string_view problem) {
  return usage_error(fmt::format("{}: no plug-in: {}", shown(path), problem));
}

Result<LibraryBytes> read_library(const std::string& path) {
  Result<std::string> bytes = read_small_file(path, "plug-in", kMaxPluginBytes, trust_problem);
  if (!bytes) return bytes.error();
  Sha256 digest;
  digest.update(*bytes);
  return LibraryBytes{path, std::move(*bytes), digest.finish()};
}

Result<const void*> load_library(const LibraryBytes& file, const char* symbol,
                                 const ProblemOf& problem_of) {
  if (is_cut_off(file.bytes)) return not_a_plugin(file.path, "the file is not whole");
  const int descriptor = copied_to_memory(file.bytes);
  if (descriptor < 0) return cannot_be_read(file.path, errno);
  const std::string copy = fmt::format("/proc/self/fd/{}", descriptor);
  void* library = nullptr;
  // The library's constructors run here. Code linked with -ffast-math has one that switches
  // denormals off.
  const LibraryFault fault =
      call_library({.library = file.path.c_str(), .function = "constructor"},
                   [&] { library = dlopen(copy.c_str(), RTLD_NOW | RTLD_LOCAL); });
  if (fault == LibraryFault::kThrew)
    return not_a_plugin(file.path, "its constructor threw an exception");
  const std::string problem = problem_in(library, symbol, problem_of);
  if (problem.empty()) return static_cast<const void*>(dlsym(library, symbol));
  if (library != nullptr) dlclose(library);
  close(descriptor);
  return not_a_plugin(file.path, problem);
}

}  // namespace hapticwall::file
