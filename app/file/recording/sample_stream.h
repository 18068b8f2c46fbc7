// Samples for other programs while a session runs: newline-delimited JSON (docs/streams.md).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "app/file/recording/recording_rows.h"
#include "core/result.h"
#include "core/sample.h"

namespace hapticwall::file {

struct StreamOptions {
  std::uint64_t every = 1;  // ticks per object, at least 1
  // True: waits for a slow reader, as long as it takes. False: its samples are lost at once.
  bool waits = false;
  bool tells_leaving = true;  // report that the reader has closed the stream
  std::function<void(const std::string& line)> tell;  // runs on the streaming thread; may be empty
  std::function<bool()> stopped;  // true if the program was asked to end; may be empty
};

// The ticks of one session on their way into a stream.
struct StreamFeed {
  CsvColumns columns;
  std::uint32_t number = 0;
  std::optional<std::uint64_t> next_tick{};  // nullopt before the first one
};

// Writes in order, and never more than the reader takes. Every write is whole lines, which a pipe
// takes at once and a file keeps in one page: a kill leaves whole lines. Only a line of more than
// PIPE_BUF bytes can be torn. Precondition: SIGPIPE is ignored. Realtime-safe: no; used by any
// thread but the loop's.
class SampleStream {
 public:
  static constexpr std::size_t kFlushBytes = std::size_t{64} << 10U;
  // Max buffer for a slow reader.
  static constexpr std::size_t kMaxPendingBytes = std::size_t{1} << 20U;
  static constexpr std::chrono::milliseconds kPatience{1000};     // max wait at the end
  static constexpr std::chrono::milliseconds kLastPatience{100};  // if the end was requested

  // `path`: a new file, a pipe, a FIFO that somebody reads, or "-" for standard output. Fails
  // (exit status 2) for a file that exists and for a FIFO without a reader.
  [[nodiscard]] static Result<std::shared_ptr<SampleStream>> open(const std::string& path,
                                                                  StreamOptions options);
  SampleStream(const SampleStream&) = delete;
  SampleStream& operator=(const SampleStream&) = delete;
  ~SampleStream() { finish(); }  // removes a file without a sample

  [[nodiscard]] bool on_standard_output() const { return on_standard_output_; }

  // A new session. Ticks of an older feed are ignored from now on.
  [[nodiscard]] StreamFeed begin(CsvColumns columns);
  // Buffers every n-th tick. Ticks that are missing since the last one count as lost; a tick that
  // is not finite does not.
  void take(StreamFeed& feed, const Tick& tick);
  // Buffers one event, a JSON object without a line end of at most kMaxEventBytes. No effect before
  // begin(). A reader that is too slow loses events, too; they count in no number.
  void add_event(std::string_view object);
  static constexpr std::size_t kMaxEventBytes = 2048;
  // Writes what is buffered and detects a reader that has left.
  void flush();
  // Writes the last line and closes the stream. If the stream does not wait, a reader that takes
  // nothing for kPatience loses the rest. Reports how many samples were lost.
  void finish();
  [[nodiscard]] bool reader_left() const;
  // Number of lost samples; after finish() it includes those that the reader left in the buffer.
  [[nodiscard]] std::uint64_t lost() const;
  // Failure of the disk. A reader that closes is no failure.
  [[nodiscard]] Failure failure() const;

 private:
  SampleStream(std::string path, int descriptor, StreamOptions options);
  void write_pending();
  [[nodiscard]] bool write_some();
  [[nodiscard]] std::size_t next_bytes() const;
  [[nodiscard]] bool stopped() const { return options_.stopped && options_.stopped(); }
  [[nodiscard]] std::uint32_t max_waits() const;
  void keep_in_page(std::size_t line);
  [[nodiscard]] std::uint64_t due(std::uint64_t first_tick, std::uint64_t end_tick) const;
  void end(int code);
  void close_file();
  void tell(const std::string& line) const;

  const std::string path_;
  const StreamOptions options_;
  bool on_standard_output_ = false;
  std::string new_file_;  // file to remove if it stays empty
  bool in_file_ = false;

  mutable std::mutex mutex_;
  int descriptor_;  // -1 after the end
  std::uint32_t feeds_ = 0;
  std::string pending_;
  std::size_t written_bytes_ = 0;  // bytes of pending_ written so far
  std::uint64_t offset_ = 0;       // offset of the next byte in a file
  bool ending_ = false;
  bool reader_left_ = false;
  std::uint64_t samples_ = 0;
  std::uint64_t lost_ = 0;
  Failure failure_;
};

}  // namespace hapticwall::file
