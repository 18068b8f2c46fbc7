#include "app/file/disk/small_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kFirstBytes = std::size_t{1} << 16U;

// Reads at most `max_bytes` + 1 bytes. Returns 0, or errno.
int read_beginning(int descriptor, std::size_t max_bytes, std::string& text) {
  std::size_t size = 0;
  while (size <= max_bytes) {
    // Grows with the file: most are far smaller than the limit.
    if (size == text.size()) {
      text.resize(std::min(std::max(kFirstBytes, 2 * size), max_bytes + 1));
    }
    const ssize_t count = read(descriptor, text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  text.resize(size);
  return 0;
}

// The descriptor, closed with the object.
class OpenFile {
 public:
  explicit OpenFile(const char* path) : descriptor(open(path, O_RDONLY | O_NOCTTY | O_CLOEXEC)) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor >= 0) close(descriptor);
  }
  const int descriptor;
};

}  // namespace

Error cannot_be_read(const std::string& path, int code) {
  return usage_error(
      fmt::format("{}: cannot be read: {}", shown(path), std::generic_category().message(code)));
}

Result<std::string> read_small_file(const std::string& path, std::string_view kind,
                                    std::size_t max_bytes, const ProblemOfFile& problem_of) {
  const auto refused = [&](std::string_view problem) {
    return usage_error(fmt::format("{}: not a {}: {}", shown(path), kind, problem));
  };
  struct stat status {};
  if (problem_of && stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    return refused("not a file");
  const OpenFile file(path.c_str());
  if (file.descriptor < 0) return cannot_be_read(path, errno);
  if (problem_of) {
    const std::string problem = problem_of(file.descriptor);
    if (!problem.empty()) return refused(problem);
  }
  std::string text;
  if (const int code = read_beginning(file.descriptor, max_bytes, text); code != 0)
    return cannot_be_read(path, code);
  if (text.size() > max_bytes) return refused(fmt::format("larger than {} bytes", max_bytes));
  if (text.empty()) return refused("empty");
  return text;
}

std::string problem_of_named(int descriptor) {
  struct statfs system {};
  if (fstatfs(descriptor, &system) != 0) return std::generic_category().message(errno);
  const bool of_kernel = system.f_type == PROC_SUPER_MAGIC || system.f_type == SYSFS_MAGIC;
  return of_kernel ? "a file of the kernel" : "";
}

Result<std::optional<std::size_t>> find_builtin(const std::string& name_or_path,
                                                std::string_view kind,
                                                std::span<const std::string_view> builtin_names) {
  const auto found = std::ranges::find(builtin_names, name_or_path);
  if (found != builtin_names.end()) {
    return std::optional(static_cast<std::size_t>(found - builtin_names.begin()));
  }
  std::error_code ignored;
  const bool looks_like_a_path = name_or_path.find_first_of("/.") != std::string::npos;
  if (looks_like_a_path || std::filesystem::exists(name_or_path, ignored)) {
    return std::optional<std::size_t>();
  }
  return usage_error(fmt::format("{} is neither a file nor a built-in {}{}; built in: {}",
                                 in_quotes(name_or_path), kind,
                                 suggestion(name_or_path, builtin_names), joined(builtin_names)));
}

}  // namespace hapticwall::file
