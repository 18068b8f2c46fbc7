// Lines from and to another program through two pipes, on a thread of its own: the owner never
// waits for that program.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "core/result.h"

namespace hapticwall::session {

// Bounded on both sides: reading pauses while kMaxLines lines or kMaxPendingBytes bytes wait, so
// that the pipe holds back a peer that writes too much or reads too little. Precondition: SIGPIPE
// is ignored. Realtime-safe: no.
class LinePipe {
 public:
  static constexpr std::size_t kMaxLines = 16;
  static constexpr std::size_t kMaxPendingBytes = std::size_t{64} << 10U;
  // A peer that reads nothing for so many bytes is given up.
  static constexpr std::size_t kMaxOutgoingBytes = std::size_t{8} << 20U;
  static constexpr std::chrono::milliseconds kPatience{300};  // max wait at the end

  // Takes copies of both descriptors. A longer line is cut to one byte more than `max_line_bytes`.
  // Fails (exit status 2) for a socket.
  [[nodiscard]] static Result<std::unique_ptr<LinePipe>> open(int input, int output,
                                                              std::size_t max_line_bytes);
  LinePipe(const LinePipe&) = delete;
  LinePipe& operator=(const LinePipe&) = delete;
  ~LinePipe();  // writes the rest, for kPatience at most

  // `line` has its end. After the peer has closed its side, no effect.
  void send(std::string_view line);
  // The next line without its end.
  [[nodiscard]] std::optional<std::string> take();
  // True if no line waits and none will come.
  [[nodiscard]] bool ended() const;
  // Waits until a line waits or the peer has ended, at most so long.
  void wait(std::chrono::milliseconds longest);

 private:
  LinePipe(int input, int output, int wake, std::size_t max_line_bytes);
  void work();
  [[nodiscard]] bool turn();
  void read_some();
  void write_some();
  void add(std::string_view bytes);
  void add_line();
  void close_output();
  void wake() const;

  const std::size_t max_line_bytes_;
  const int wake_;  // an eventfd
  int input_;       // -1 after its end; the thread's, like output_ and partial_
  int output_;
  std::string partial_;

  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::deque<std::string> lines_;
  std::string outgoing_;
  bool input_ended_ = false;
  bool output_ended_ = false;
  bool stops_ = false;
  std::thread thread_;
};

}  // namespace hapticwall::session
