#include "app/file/disk/small_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr std::size_t kFirstBytes = std::size_t{1} << 16U;

// Reads at most one byte more than `max_bytes`.
Result<std::string> read_beginning(const std::string& path, std::size_t max_bytes) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot_be_read(path, errno);
  std::string text;
  std::size_t size = 0;
  while (size <= max_bytes) {
    // Grows with the file: most are far smaller than the limit.
    if (size == text.size()) {
      text.resize(std::min(std::max(kFirstBytes, 2 * size), max_bytes + 1));
    }
    const ssize_t count = read(descriptor, text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int code = errno;
      close(descriptor);
      return cannot_be_read(path, code);
    }
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  close(descriptor);
  text.resize(size);
  return text;
}

}  // namespace

Error cannot_be_read(const std::string& path, int code) {
  return usage_error(
      fmt::format("{}: cannot be read: {}", shown(path), std::generic_category().message(code)));
}

Result<std::string> read_small_file(const std::string& path, std::string_view kind,
                                    std::size_t max_bytes) {
  Result<std::string> text = read_beginning(path, max_bytes);
  if (!text) return text;
  if (text->size() > max_bytes) {
    return usage_error(
        fmt::format("{}: not a {}: larger than {} bytes", shown(path), kind, max_bytes));
  }
  if (text->empty()) return usage_error(fmt::format("{}: not a {}: empty", shown(path), kind));
  return text;
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
