// The other end of a trial pipe, for tests: it writes and reads when the test does.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/file/trials/trial_message.h"
#include "app/session/line_pipe.h"

namespace hapticwall::session::test {

class Peer {
 public:
  Peer() {
    std::signal(SIGPIPE, SIG_IGN);
    EXPECT_EQ(pipe2(to_program_.data(), O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(from_program_.data(), O_CLOEXEC), 0);
    EXPECT_EQ(fcntl(from_program_[0], F_SETFL, O_NONBLOCK), 0);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  ~Peer() {
    leave();
    for (const int end : {to_program_[0], from_program_[0], from_program_[1]}) {
      if (end >= 0) close(end);
    }
  }

  // The program's end. Once.
  std::unique_ptr<LinePipe> program_end() {
    auto opened = LinePipe::open(to_program_[0], from_program_[1], file::kMaxMessageBytes);
    EXPECT_TRUE(opened.ok());
    close(std::exchange(to_program_[0], -1));
    close(std::exchange(from_program_[1], -1));
    return std::move(*opened);
  }

  void write(const std::string& text) const {
    ASSERT_EQ(::write(to_program_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  [[nodiscard]] int writing_end() const { return to_program_[1]; }
  // Closes what it writes.
  void leave() {
    if (to_program_[1] >= 0) close(std::exchange(to_program_[1], -1));
  }
  // Closes what it reads.
  void read_no_more() { close(std::exchange(from_program_[0], -1)); }

  // Waits for `count` further messages.
  std::vector<nlohmann::json> messages(std::size_t count) {
    std::vector<nlohmann::json> found;
    for (int i = 0; i < 10'000 && found.size() < count; ++i) {
      std::array<char, 4096> bytes{};
      const ssize_t got = read(from_program_[0], bytes.data(), bytes.size());
      if (got > 0) text_.append(bytes.data(), static_cast<std::size_t>(got));
      for (std::size_t end = 0;
           found.size() < count && (end = text_.find('\n')) != std::string::npos;
           text_.erase(0, end + 1))
        found.push_back(nlohmann::json::parse(text_.substr(0, end)));
      if (got <= 0 && found.size() < count) usleep(1000);
    }
    EXPECT_EQ(found.size(), count);
    return found;
  }
  // The next message must have this name.
  nlohmann::json message(const std::string& name) {
    const std::vector<nlohmann::json> found = messages(1);
    if (found.empty()) return {};
    EXPECT_TRUE(found.front().contains(name)) << found.front();
    return found.front().contains(name) ? found.front()[name] : nlohmann::json();
  }

 private:
  std::array<int, 2> to_program_{-1, -1};
  std::array<int, 2> from_program_{-1, -1};
  std::string text_;
};

}  // namespace hapticwall::session::test
