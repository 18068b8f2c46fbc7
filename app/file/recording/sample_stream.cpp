#include "app/file/recording/sample_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "app/file/disk/atomic_file.h"
#include "app/file/text/text.h"

namespace hapticwall::file {
namespace {

constexpr mode_t kStreamFileMode = 0666;  // before the umask
constexpr int kPipeBytes = 1 << 20;       // the limit for ordinary users
constexpr std::size_t kMaxLineBytes = 8192;
// A kill interrupts write() between the pages of a file only.
constexpr std::size_t kPageBytes = 4096;
constexpr std::chrono::milliseconds kWaitInterval{50};

std::string reason(int code) { return std::generic_category().message(code); }

std::string path_of(const OutputPlace& place) {
  return place.descriptor ? fmt::format("/proc/self/fd/{}", *place.descriptor) : place.path;
}

// Opened anew, because O_NONBLOCK on an inherited descriptor would reach the programs that share
// it.
int open_pipe(const OutputPlace& place) {
  const int descriptor =
      ::open(path_of(place).c_str(), O_WRONLY | O_NONBLOCK | O_APPEND | O_NOCTTY | O_CLOEXEC);
  if (descriptor >= 0) static_cast<void>(fcntl(descriptor, F_SETPIPE_SZ, kPipeBytes));
  return descriptor;
}

// Samples among these lines; events and the end are none.
std::uint64_t samples_in(std::string_view text) {
  constexpr std::string_view kSample = "{\"tick\":";
  std::uint64_t samples = 0;
  for (const std::string_view line : split(text, '\n'))
    samples += line.starts_with(kSample) ? 1U : 0U;
  return samples;
}

int open_new(const OutputPlace& place) {
  return ::open(place.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kStreamFileMode);
}

Error cannot_stream(const std::string& path, const OutputPlace& place, int code) {
  std::error_code ignored;
  const std::string option = "--stream " + in_quotes(path) + ": ";
  if (code == EEXIST) return usage_error(option + "it exists; choose another name");
  if (code == ENXIO && std::filesystem::is_socket(path_of(place), ignored))
    return usage_error(option + "it is a socket; use a pipe");
  if (code == ENXIO) return usage_error(option + "nobody reads it; start the reader first");
  return file_error(fmt::format("{}: cannot be written: {}", shown(path), reason(code)));
}

}  // namespace

Result<std::shared_ptr<SampleStream>> SampleStream::open(const std::string& path,
                                                         StreamOptions options) {
  const Result<OutputPlace> place = output_place(path == "-" ? "/proc/self/fd/1" : path);
  if (!place) return place.error();
  const bool is_new = place->kind == PlaceKind::kFile;
  const int descriptor = is_new ? open_new(*place) : open_pipe(*place);
  if (descriptor < 0) return cannot_stream(path, *place, errno);
  std::shared_ptr<SampleStream> stream(new SampleStream(path, descriptor, std::move(options)));
  stream->on_standard_output_ = place->descriptor == STDOUT_FILENO;
  if (is_new) stream->new_file_ = place->path;
  struct stat status {};
  stream->in_file_ = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  if (stream->in_file_) stream->offset_ = static_cast<std::uint64_t>(status.st_size);
  return stream;
}

// take() never allocates: a line is whole or absent.
SampleStream::SampleStream(std::string path, int descriptor, StreamOptions options)
    : path_(std::move(path)), options_(std::move(options)), descriptor_(descriptor) {
  pending_.reserve(kMaxPendingBytes + kMaxLineBytes + kPageBytes);
}

StreamFeed SampleStream::begin(CsvColumns columns) {
  const std::scoped_lock lock(mutex_);
  return {std::move(columns), ++feeds_};
}

// The number of samples among these ticks.
std::uint64_t SampleStream::due(std::uint64_t first_tick, std::uint64_t end_tick) const {
  const auto up_to = [&](std::uint64_t tick) {
    return (tick + options_.every - 1) / options_.every;
  };
  return up_to(end_tick) - up_to(first_tick);
}

void SampleStream::take(StreamFeed& feed, const Tick& tick) {
  const std::uint64_t number = tick.x().tick;
  const std::scoped_lock lock(mutex_);
  if (descriptor_ < 0 || feed.number != feeds_) return;
  const std::uint64_t expected = std::min(feed.next_tick.value_or(number), number);
  lost_ += due(expected, number);
  feed.next_tick = number + 1;
  if (due(number, number + 1) == 0 || !is_finite(tick)) return;
  if (pending_.size() >= kFlushBytes) write_pending();
  if (pending_.size() >= kMaxPendingBytes) {
    ++lost_;
    return;
  }
  const std::size_t line = pending_.size();
  append_json_object(pending_, tick, feed.columns, lost_);
  if (in_file_) keep_in_page(line);
  ++samples_;
}

void SampleStream::add_event(std::string_view object) {
  const std::scoped_lock lock(mutex_);
  if (descriptor_ < 0 || feeds_ == 0 || object.size() > kMaxEventBytes) return;
  if (pending_.size() >= kMaxPendingBytes) return;
  const std::size_t line = pending_.size();
  pending_.append(object) += '\n';
  if (in_file_) keep_in_page(line);
}

// Starts the newest line, at `line` of pending_, on a new page if it does not fit: spaces before
// the previous line's end fill the page.
void SampleStream::keep_in_page(std::size_t line) {
  const std::size_t room = kPageBytes - (offset_ + line) % kPageBytes;
  if (line == 0 || room == kPageBytes || pending_.size() - line <= room) return;
  pending_.insert(line - 1, room, ' ');
}

void SampleStream::flush() {
  const std::scoped_lock lock(mutex_);
  write_pending();
  pollfd reader{descriptor_, 0, 0};
  if (descriptor_ >= 0 && poll(&reader, 1, 0) > 0 && (reader.revents & POLLERR) != 0) end(EPIPE);
}

// How often to wait for a reader that takes nothing.
std::uint32_t SampleStream::max_waits() const {
  const bool asked = stopped();
  if (options_.waits && !asked) return std::numeric_limits<std::uint32_t>::max();
  if (!ending_) return 0;
  return static_cast<std::uint32_t>((asked ? kLastPatience : kPatience) / kWaitInterval);
}

void SampleStream::write_pending() {
  for (std::uint32_t waits = 0; descriptor_ >= 0 && next_bytes() > 0;) {
    if (write_some()) {
      if (!stopped()) waits = 0;
      continue;
    }
    if (descriptor_ < 0 || waits++ >= max_waits()) break;
    pollfd reader{descriptor_, POLLOUT, 0};
    static_cast<void>(poll(&reader, 1, static_cast<int>(kWaitInterval.count())));
  }
  pending_.erase(0, written_bytes_);
  written_bytes_ = 0;
}

// Size of the next write(): the whole lines that a pipe takes at once, or a full page of a file and
// at last its rest.
std::size_t SampleStream::next_bytes() const {
  const std::string_view rest = std::string_view(pending_).substr(written_bytes_);
  if (in_file_) {
    const std::size_t room = kPageBytes - offset_ % kPageBytes;
    return rest.size() >= room ? room : ending_ ? rest.size() : 0;
  }
  if (rest.size() <= PIPE_BUF) return rest.size();
  const std::size_t end = rest.rfind('\n', PIPE_BUF - 1);
  return (end == std::string_view::npos ? rest.find('\n') : end) + 1;
}

// Writes once; true if the reader took some bytes.
bool SampleStream::write_some() {
  const ssize_t bytes = write(descriptor_, pending_.data() + written_bytes_, next_bytes());
  if (bytes < 0 && errno != EAGAIN && errno != EINTR) end(errno);
  if (bytes <= 0) return false;
  written_bytes_ += static_cast<std::size_t>(bytes);
  offset_ += static_cast<std::uint64_t>(bytes);
  return true;
}

void SampleStream::end(int code) {
  // A full disk may have taken a part of a page.
  const auto whole = static_cast<off_t>(offset_ - offset_ % kPageBytes);
  [[maybe_unused]] const int ignored = new_file_.empty() ? 0 : ftruncate(descriptor_, whole);
  close_file();
  if (code == EPIPE) {
    reader_left_ = true;
    if (options_.tells_leaving) tell("the reader has closed it; the stream ends");
    return;
  }
  failure_ = file_error(fmt::format("--stream {}: {}", in_quotes(path_), reason(code)));
  tell(reason(code) + "; the stream ends");
}

void SampleStream::finish() {
  const std::scoped_lock lock(mutex_);
  if (descriptor_ < 0) return;
  if (samples_ == 0 && !new_file_.empty()) unlink(new_file_.c_str());
  // A stream that no session began has no end either.
  const std::size_t line = pending_.size();
  if (feeds_ > 0)
    pending_ += fmt::format("{{\"end\":true,\"samples\":{},\"lost\":{}}}\n", samples_, lost_);
  if (in_file_) keep_in_page(line);
  ending_ = true;
  write_pending();
  const std::uint64_t unread = samples_in(pending_);
  const std::uint64_t all = samples_ + lost_;
  if (descriptor_ < 0) return;
  lost_ += unread;
  if (lost_ > 0)
    tell(fmt::format("{} of {} samples were lost: the reader is too slow", lost_, all));
  close_file();
}

bool SampleStream::reader_left() const {
  const std::scoped_lock lock(mutex_);
  return reader_left_;
}

std::uint64_t SampleStream::lost() const {
  const std::scoped_lock lock(mutex_);
  return lost_;
}

void SampleStream::close_file() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
}

void SampleStream::tell(const std::string& line) const {
  if (options_.tell) options_.tell("--stream " + in_quotes(path_) + ": " + line);
}

Failure SampleStream::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

}  // namespace hapticwall::file
