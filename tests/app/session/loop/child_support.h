// A session in a child process, which may die or be stopped. Shared memory holds the commands that
// its device received.
#pragma once

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/session/live_session.h"
#include "tests/app/session/support.h"

namespace hapticwall::session::test {

inline constexpr double kFreeM = 0.03;
inline constexpr double kInsideM = 0.0502;  // inside the wall of contact_scene()
inline constexpr int kAlive = 99;           // exit status of a child that should have been killed
inline constexpr std::size_t kMaxHeard = 200'000;

struct Heard {
  std::atomic<double> position_m{kFreeM};  // set by parent or child
  std::atomic<double> newest_n{0.0};
  std::atomic<bool> enabled{false};
  std::atomic<bool> closed{false};
  std::atomic<std::uint64_t> writes{0};
  std::atomic<std::uint64_t> pushes{0};  // writes with force
  std::atomic<bool> go_on{false};        // set by the parent
  std::atomic<std::uint64_t> note{0};    // the child's
  std::array<double, kMaxHeard> forces_n{};
  std::array<std::int64_t, kMaxHeard> wakes_ns{};
  std::int64_t start_ns = 0;
  std::uint64_t wakes = 0;
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;

  [[nodiscard]] bool pushed() const { return pushes.load() > 0; }
};
static_assert(std::atomic<double>::is_always_lock_free);

class Shared {
 public:
  // Memory that is shared with forked children.
  Shared() : heard_(new (map(MAP_SHARED | MAP_ANONYMOUS, -1)) Heard) {}
  // Memory that is shared with other programs as children: they find it through this environment
  // variable.
  explicit Shared(const char* variable) {
    const char* known = std::getenv(variable);
    const int file = known != nullptr ? std::stoi(known) : memfd_create(variable, 0);
    if (file < 0 || ftruncate(file, sizeof(Heard)) != 0) throw std::runtime_error("memfd");
    void* memory = map(MAP_SHARED, file);
    heard_ = known != nullptr ? static_cast<Heard*>(memory) : new (memory) Heard;
    if (known != nullptr) return;
    setenv(variable, std::to_string(file).c_str(), 1);
    variable_ = variable;
  }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  ~Shared() {
    munmap(heard_, sizeof(Heard));
    if (variable_ != nullptr) unsetenv(variable_);  // its file ends with the process
  }
  Heard* operator->() const { return heard_; }
  Heard& operator*() const { return *heard_; }

 private:
  static void* map(int flags, int file) {
    void* memory = mmap(nullptr, sizeof(Heard), PROT_READ | PROT_WRITE, flags, file, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("mmap");
    return memory;
  }

  Heard* heard_ = nullptr;
  const char* variable_ = nullptr;
};

// A real device, as the loop sees it.
class SharedDevice : public device::Device {
 public:
  explicit SharedDevice(Heard& heard) : heard_(heard) {}
  [[nodiscard]] device::DeviceInfo info() const override {
    constexpr device::MotionLimits kFast{-1.0, 1.0, 1e6};  // a test moves its handle at once
    return {"shared", false, 0.0, 0.0, kFast, 0.0, "", 1.0};
  }
  [[nodiscard]] Failure open() override { return std::nullopt; }
  [[nodiscard]] DeviceReading read() override {
    if (on_read) on_read();
    return {heard_.position_m.load(), 0.0, DeviceState::kOk};
  }
  void enable(bool enabled) override { heard_.enabled = enabled; }
  void write(double force_n) override {
    heard_.newest_n = force_n;
    if (force_n != 0.0) ++heard_.pushes;
    const std::uint64_t number = heard_.writes++;
    if (number < kMaxHeard) heard_.forces_n.at(number) = force_n;
  }
  void close() override { heard_.closed = true; }

  [[nodiscard]] std::string trouble_details() const override {
    if (on_words) on_words();
    return {};
  }

  std::function<void()> on_read;   // called on the loop's thread
  std::function<void()> on_words;  // called on the owner's thread, in every frame of a window

 private:
  Heard& heard_;
};

// A session that pushes, with the force still rising: the owner's thread is this one.
inline std::unique_ptr<LiveSession> pushing_session(
    Heard& heard, std::unique_ptr<SharedDevice> device = nullptr) {
  if (!device) device = std::make_unique<SharedDevice>(heard);
  SessionOptions options;
  options.allow_no_realtime = true;
  auto session = LiveSession::start_on(std::move(device), contact_scene(), options);
  if (!session) throw std::runtime_error(session.error().message);
  // A delay by the machine disarms the loop: arm again.
  while (heard.newest_n.load() == 0.0) {
    heard.position_m = kFreeM;
    (*session)->arm(true);
    if (!eventually([&] { return (*session)->snapshot().arming.gain > 0.0; })) break;
    heard.position_m = kInsideM;
    const auto decided = [&] {
      return heard.newest_n.load() != 0.0 || (*session)->snapshot().arming.gain == 0.0;
    };
    if (!eventually(decided)) break;
  }
  return std::move(*session);
}

// Runs `life` in a silent child process without a core dump.
inline pid_t start_child(const std::function<void()>& life) {
  const pid_t child = fork();
  if (child != 0) return child;
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(kAlive);
  life();
  _exit(kAlive);
}

// Exit status of a child. A child that does not end fails the test and is killed.
inline int status_of(pid_t child) {
  int status = -1;
  if (eventually([&] { return waitpid(child, &status, WNOHANG) == child; })) return status;
  ADD_FAILURE() << "the child does not end";
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return status;
}

// Expects that the kernel killed the child; a sanitizer with its own handler ends the process
// itself.
inline void expect_killed_by(int signal, int status) {
#if defined(__SANITIZE_ADDRESS__)
  if (WIFEXITED(status)) {
    EXPECT_NE(WEXITSTATUS(status), 0);
    EXPECT_NE(WEXITSTATUS(status), kAlive);
    return;
  }
#endif
  ASSERT_TRUE(WIFSIGNALED(status)) << "exit status " << WEXITSTATUS(status);
  EXPECT_EQ(WTERMSIG(status), signal);
}

}  // namespace hapticwall::session::test
