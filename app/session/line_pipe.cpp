#include "app/session/line_pipe.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <system_error>
#include <utility>

namespace hapticwall::session {
namespace {

constexpr std::size_t kReadBytes = 4096;

bool is_socket(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

// Opened anew, because O_NONBLOCK on an inherited descriptor would reach the programs that share
// it.
int open_output(int descriptor) {
  return ::open(fmt::format("/proc/self/fd/{}", descriptor).c_str(),
                O_WRONLY | O_NONBLOCK | O_APPEND | O_NOCTTY | O_CLOEXEC);
}

Error cannot_open(int code) {
  return file_error(
      fmt::format("--trials -: cannot be opened: {}", std::generic_category().message(code)));
}

}  // namespace

Result<std::unique_ptr<LinePipe>> LinePipe::open(int input, int output,
                                                 std::size_t max_line_bytes) {
  if (is_socket(input) || is_socket(output))
    return usage_error("--trials -: standard input or output is a socket; use pipes");
  const int in = fcntl(input, F_DUPFD_CLOEXEC, 0);
  const int out = in < 0 ? -1 : open_output(output);
  const int wake = out < 0 ? -1 : eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake < 0) {
    const int code = errno;
    for (const int descriptor : {in, out}) {
      if (descriptor >= 0) close(descriptor);
    }
    return cannot_open(code);
  }
  return std::unique_ptr<LinePipe>(new LinePipe(in, out, wake, max_line_bytes));
}

LinePipe::LinePipe(int input, int output, int wake, std::size_t max_line_bytes)
    : max_line_bytes_(max_line_bytes), wake_(wake), input_(input), output_(output) {
  thread_ = std::thread([this] { work(); });
}

LinePipe::~LinePipe() {
  {
    const std::scoped_lock lock(mutex_);
    stops_ = true;
  }
  wake();
  thread_.join();
  close_output();
  if (input_ >= 0) close(input_);
  close(wake_);
}

void LinePipe::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t ignored = write(wake_, &one, sizeof one);
}

void LinePipe::send(std::string_view line) {
  {
    const std::scoped_lock lock(mutex_);
    if (output_ended_) return;
    if (outgoing_.size() + line.size() > kMaxOutgoingBytes) {
      output_ended_ = true;
      outgoing_.clear();
    }
    if (!output_ended_) outgoing_ += line;
  }
  wake();
}

std::optional<std::string> LinePipe::take() {
  std::optional<std::string> line;
  {
    const std::scoped_lock lock(mutex_);
    if (lines_.empty()) return std::nullopt;
    line = std::move(lines_.front());
    lines_.pop_front();
  }
  wake();
  return line;
}

bool LinePipe::ended() const {
  const std::scoped_lock lock(mutex_);
  return lines_.empty() && input_ended_;
}

void LinePipe::wait(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, longest, [this] { return !lines_.empty() || input_ended_; });
}

void LinePipe::work() {
  std::optional<std::chrono::steady_clock::time_point> end;
  while (turn()) {
    const std::scoped_lock lock(mutex_);
    if (!stops_) continue;
    const auto now = std::chrono::steady_clock::now();
    if (!end) end = now + kPatience;
    if (outgoing_.empty() || now >= *end) return;
  }
}

// Waits for one event and handles it.
bool LinePipe::turn() {
  bool reads = false;
  bool writes = false;
  bool stops = false;
  {
    const std::scoped_lock lock(mutex_);
    if (output_ended_) close_output();
    stops = stops_;
    if (stops && (outgoing_.empty() || output_ < 0)) return false;
    reads = !stops && lines_.size() < kMaxLines && outgoing_.size() < kMaxPendingBytes;
    writes = !outgoing_.empty();
  }
  std::array<pollfd, 3> ready{pollfd{wake_, POLLIN, 0}, pollfd{reads ? input_ : -1, POLLIN, 0},
                              pollfd{output_, static_cast<short>(writes ? POLLOUT : 0), 0}};
  constexpr int kStepMs = 20;
  if (poll(ready.data(), ready.size(), stops ? kStepMs : -1) < 0) return errno == EINTR;
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t ignored = read(wake_, &count, sizeof count);
  if (ready[1].revents != 0) read_some();
  if ((ready[2].revents & POLLOUT) != 0) {
    write_some();
  } else if (ready[2].revents != 0) {
    const std::scoped_lock lock(mutex_);
    output_ended_ = true;  // closed in the next turn
    outgoing_.clear();
  }
  return true;
}

void LinePipe::read_some() {
  std::array<char, kReadBytes> bytes{};
  const ssize_t count = read(input_, bytes.data(), bytes.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return;
  const std::scoped_lock lock(mutex_);
  if (count > 0) {
    add({bytes.data(), static_cast<std::size_t>(count)});
  } else {
    close(std::exchange(input_, -1));
    input_ended_ = true;
  }
  news_.notify_all();
}

// A read may hold many short lines: all are kept, at most kReadBytes of them.
void LinePipe::add(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::string_view part = bytes.substr(0, end);
    const std::size_t room = max_line_bytes_ + 1 - partial_.size();
    partial_ += part.substr(0, room);
    if (end == std::string_view::npos) return;
    bytes.remove_prefix(end + 1);
    add_line();
  }
}

void LinePipe::add_line() {
  if (partial_.ends_with('\r')) partial_.pop_back();
  if (!partial_.empty()) lines_.push_back(std::move(partial_));
  partial_.clear();
}

void LinePipe::write_some() {
  const std::scoped_lock lock(mutex_);
  const std::size_t count = std::min<std::size_t>(outgoing_.size(), PIPE_BUF);
  const ssize_t written = write(output_, outgoing_.data(), count);
  if (written > 0) outgoing_.erase(0, static_cast<std::size_t>(written));
  if (written < 0 && errno != EAGAIN && errno != EINTR) {
    outgoing_.clear();
    output_ended_ = true;  // closed in the next turn
  }
}

void LinePipe::close_output() {
  if (output_ >= 0) close(std::exchange(output_, -1));
}

}  // namespace hapticwall::session
