// The other end of a stream: a FIFO that a test reads when it likes.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/file/recording/sample_stream.h"

namespace hapticwall::file::test {

class StreamReader {
 public:
  explicit StreamReader(std::string path) : path_(std::move(path)) {
    std::signal(SIGPIPE, SIG_IGN);
    if (mkfifo(path_.c_str(), 0600) != 0) throw std::runtime_error("mkfifo");
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  }
  StreamReader(const StreamReader&) = delete;
  StreamReader& operator=(const StreamReader&) = delete;
  ~StreamReader() { close_early(); }

  void close_early() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  // Reads at most 4096 bytes; false if there are none.
  bool read_some() {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
    if (count > 0) text_.append(bytes.data(), static_cast<std::size_t>(count));
    return count > 0;
  }
  // Everything that was read so far, with what is in the pipe.
  const std::string& drained() {
    while (read_some()) {
    }
    return text_;
  }
  // The whole lines so far, as objects. Throws for a line that is no JSON.
  [[nodiscard]] std::vector<nlohmann::json> objects() {
    drained();
    std::vector<nlohmann::json> lines;
    std::istringstream text(text_.substr(0, text_.rfind('\n') + 1));
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    return lines;
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::string text_;
  int descriptor_ = -1;
};

// The stream's messages go to `told`, which may be null.
inline std::shared_ptr<SampleStream> opened_stream(
    const std::string& path, const std::shared_ptr<std::vector<std::string>>& told = nullptr,
    StreamOptions options = {}) {
  options.tell = [told](const std::string& line) {
    if (told) told->push_back(line);
  };
  auto stream = SampleStream::open(path, std::move(options));
  if (!stream) throw std::runtime_error(stream.error().message);
  return *stream;
}

inline std::vector<std::uint64_t> ticks_in(const std::vector<nlohmann::json>& objects) {
  std::vector<std::uint64_t> ticks;
  for (const nlohmann::json& object : objects) {
    if (object.contains("tick")) ticks.push_back(object["tick"]);
  }
  return ticks;
}

}  // namespace hapticwall::file::test
