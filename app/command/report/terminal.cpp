#include "app/command/report/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

// Bytes of a message.
constexpr std::size_t kMaxLineBytes = 1000;

// 0, or errno.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

Failure write_output(std::string_view text) {
  return write_stream(STDOUT_FILENO, "standard output", text);
}

Failure write_stream(int descriptor, std::string_view name, std::string_view text) {
  const int code = write_all(descriptor, text);
  if (code == 0 || code == EPIPE) return {};
  return file_error(
      fmt::format("{} could not be written: {}", name, std::generic_category().message(code)));
}

int report(const Error& error) {
  tell("error: " + error.message);
  return static_cast<int>(error.kind);
}

void tell(std::string_view line) {
  std::string text(line);
  std::replace(text.begin(), text.end(), '\n', ' ');
  write_all(STDERR_FILENO, file::shown(text, kMaxLineBytes) + '\n');
}

}  // namespace hapticwall::command
