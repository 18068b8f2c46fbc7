// However the process ends, the last command to the device is zero force.
#include "app/session/loop/crash_stop.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/app/session/loop/child_support.h"

namespace hapticwall::session {
namespace {

using test::eventually;
using test::expect_killed_by;
using test::Heard;
using test::pushing_session;
using test::Shared;
using test::SharedDevice;
using test::start_child;
using test::status_of;

// An inaccessible page: a wrong pointer.
volatile int* forbidden() {
  static void* page = mmap(nullptr, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return static_cast<volatile int*>(page);
}

void use_wrong_pointer() { *forbidden() = 1; }

// A page behind the end of a file.
void use_lost_page() {
  std::FILE* file = std::tmpfile();
  if (file == nullptr) return;
  void* page = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, fileno(file), 0);
  *static_cast<volatile int*>(page) = 1;
}

constexpr int kEndless = 1'000'000'000;  // calls; no stack has room for them
[[gnu::noinline]] int fill_stack(int depth) {
  std::array<int, 1024> frame{};
  volatile int* kept = frame.data();
  kept[0] = depth;
  return depth == kEndless ? depth : fill_stack(depth + 1) + kept[0];
}

void throw_something() { throw std::runtime_error("nobody catches this"); }

// NOLINTNEXTLINE(bugprone-exception-escape): this is what it is for
void throw_to_nobody() noexcept { throw_something(); }  // cppcheck-suppress throwInNoexceptFunction

void in_another_thread() { std::thread(use_wrong_pointer).join(); }

void thrown_in_another_thread() { std::thread(throw_something).join(); }

template <int kSignal>
void sent() {
  kill(getpid(), kSignal);
}

// Signals of a terminal: for a key, or because it is closed.
void from_terminal(char key) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  std::array<char, 64> name{};
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) return;
  if (setsid() < 0 || ptsname_r(terminal, name.data(), name.size()) != 0) return;
  if (open(name.data(), O_RDWR) < 0) return;  // the terminal of the new session
  if (key == '\0') {
    close(terminal);
  } else if (write(terminal, &key, 1) != 1) {
    return;
  }
  while (true) pause();
}

struct End {
  const char* name;
  void (*bring_about)();
  int signal;
};
std::ostream& operator<<(std::ostream& out, const End& end) { return out << end.name; }

class CrashStopEnds : public ::testing::TestWithParam<End> {};

TEST_P(CrashStopEnds, WithZeroForceAndTheSameSignal) {
  const Shared heard;
  const pid_t child = start_child([&] {
    const auto session = pushing_session(*heard);
    GetParam().bring_about();
  });
  expect_killed_by(GetParam().signal, status_of(child));
  EXPECT_TRUE(heard->pushed());
  EXPECT_EQ(heard->newest_n, 0.0);
  EXPECT_FALSE(heard->enabled);
  EXPECT_TRUE(heard->closed);
}

std::vector<End> all_ends() {
  std::vector<End> ends{
      {"WrongPointer", use_wrong_pointer, SIGSEGV},
      {"WrongPointerInAnotherThread", in_another_thread, SIGSEGV},
      {"FullStack", [] { static_cast<void>(fill_stack(0)); }, SIGSEGV},
      {"LostPage", use_lost_page, SIGBUS},
      {"Abort", [] { std::abort(); }, SIGABRT},
      {"UncaughtException", throw_to_nobody, SIGABRT},
      {"UncaughtExceptionInAnotherThread", thrown_in_another_thread, SIGABRT},
      {"SentSegv", sent<SIGSEGV>, SIGSEGV},
      {"SentFpe", sent<SIGFPE>, SIGFPE},
      {"SentIll", sent<SIGILL>, SIGILL},
      {"Hangup", sent<SIGHUP>, SIGHUP},
      {"Quit", sent<SIGQUIT>, SIGQUIT},
      {"Interrupt", sent<SIGINT>, SIGINT},
      {"Terminate", sent<SIGTERM>, SIGTERM},
      {"ProcessorTime", sent<SIGXCPU>, SIGXCPU},
      {"TerminalClosed", [] { from_terminal('\0'); }, SIGHUP},
  };
#if !defined(__SANITIZE_THREAD__)  // it may keep the signal of a key to itself, for good
  ends.push_back({"TerminalsQuit", [] { from_terminal('\x1c'); }, SIGQUIT});
  ends.push_back({"TerminalsInterrupt", [] { from_terminal('\x03'); }, SIGINT});
#endif
  return ends;
}

INSTANTIATE_TEST_SUITE_P(Ways, CrashStopEnds, ::testing::ValuesIn(all_ends()),
                         [](const auto& way) { return std::string(way.param.name); });

// Xlib calls exit() like this when the display server dies.
TEST(CrashStop, AnExitOfALibraryEndsTheForceFirst) {
  const Shared heard;
  const pid_t child = start_child([&] {
    const auto session = pushing_session(*heard);
    std::exit(1);
  });
  const int status = status_of(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_TRUE(heard->pushed());
  EXPECT_EQ(heard->newest_n, 0.0);
  EXPECT_FALSE(heard->enabled);
  EXPECT_TRUE(heard->closed);
}

// The thread that should write the zero is the one that ends the process.
TEST(CrashStop, AnEndByTheLoopsOwnThreadEndsTheForceFirst) {
  struct Way {
    void (*end)();
    int status;
  };
  const std::vector<Way> ways{{[] { std::exit(7); }, W_EXITCODE(7, 0)},
                              {[] { std::quick_exit(7); }, W_EXITCODE(7, 0)},
                              {[] { std::abort(); }, W_EXITCODE(0, SIGABRT)}};
  for (const Way& way : ways) {
    const Shared heard;
    const pid_t child = start_child([&] {
      auto device = std::make_unique<SharedDevice>(*heard);
      device->on_read = [&] {
        if (heard->pushed()) way.end();
      };
      const auto session = pushing_session(*heard, std::move(device));
      while (true) pause();
    });
    const int status = status_of(child);
    if (WIFEXITED(way.status)) {
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), WEXITSTATUS(way.status));
    } else {
      expect_killed_by(WTERMSIG(way.status), status);
    }
    EXPECT_TRUE(heard->pushed());
    EXPECT_EQ(heard->newest_n, 0.0);
    EXPECT_FALSE(heard->enabled);
  }
}

// After a fault on the loop's thread the device ends the force, 20 ms after the last command. The
// process must still end.
TEST(CrashStop, AFaultOfTheLoopsOwnThreadEndsTheProcess) {
  using Fault = void (*)();
  for (const auto& [fault, signal] : {std::pair<Fault, int>{use_wrong_pointer, SIGSEGV},
                                      std::pair<Fault, int>{throw_to_nobody, SIGABRT}}) {
    const Shared heard;
    const Fault bring_about = fault;
    const pid_t child = start_child([&] {
      auto device = std::make_unique<SharedDevice>(*heard);
      device->on_read = [&] {
        if (heard->pushed()) bring_about();
      };
      const auto session = pushing_session(*heard, std::move(device));
      while (true) pause();
    });
    expect_killed_by(signal, status_of(child));
  }
}

TEST(CrashStop, ALoopThatHangsInItsDeviceDoesNotKeepTheProcessFromEnding) {
  const Shared heard;
  const pid_t child = start_child([&] {
    auto device = std::make_unique<SharedDevice>(*heard);
    device->on_read = [&heard] {
      while (heard->pushed()) pause();
    };
    const auto session = pushing_session(*heard, std::move(device));
    use_wrong_pointer();
  });
  expect_killed_by(SIGSEGV, status_of(child));
}

TEST(CrashStop, EndsEveryLoop) {
  const Shared first;
  const Shared second;
  const pid_t child = start_child([&] {
    const auto one = pushing_session(*first);
    const auto other = pushing_session(*second);
    use_wrong_pointer();
  });
  expect_killed_by(SIGSEGV, status_of(child));
  for (const Heard* heard : {&*first, &*second}) {
    EXPECT_TRUE(heard->pushed());
    EXPECT_EQ(heard->newest_n, 0.0);
    EXPECT_TRUE(heard->closed);
  }
}

TEST(CrashStop, RowsOnTheDiskStay) {
  const test::TemporaryFolder folder;
  const Shared heard;
  const pid_t child = start_child([&] {
    const auto session = pushing_session(*heard);
    if (session->start_recording(folder.file("a.csv"))) return;
    const std::string partial = folder.file("a.csv.partial");
    const auto on_disk = [&] { return std::filesystem::file_size(partial) > 10'000; };
    if (eventually(on_disk)) use_wrong_pointer();
  });
  expect_killed_by(SIGSEGV, status_of(child));
  EXPECT_EQ(heard->newest_n, 0.0);
  EXPECT_GT(test::lines_of(folder.file("a.csv.partial")).size(), 10U);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.csv")));
}

struct sigaction present(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action;
}
void somebody_elses(int /*signal*/) {}

TEST(CrashStop, CatchesWhileOneLivesAndPutsEverythingBack) {
  const auto before = present(SIGSEGV).sa_sigaction;
  auto one = std::make_unique<CrashStop>();
  const auto ours = present(SIGSEGV).sa_sigaction;
  EXPECT_NE(ours, before);
  auto other = std::make_unique<CrashStop>();
  one.reset();
  EXPECT_EQ(present(SIGSEGV).sa_sigaction, ours);
  other.reset();
  EXPECT_EQ(present(SIGSEGV).sa_sigaction, before);
}

TEST(CrashStop, LeavesWhatIsIgnoredOrAskedForByOthers) {
  const auto hangup = std::signal(SIGHUP, SIG_IGN);  // nohup
  const auto terminate = std::signal(SIGTERM, somebody_elses);
  {
    const CrashStop crash_stop;
    EXPECT_EQ(present(SIGHUP).sa_handler, SIG_IGN);
    EXPECT_EQ(present(SIGTERM).sa_handler, somebody_elses);
    std::signal(SIGQUIT, somebody_elses);  // asked for later
  }
  EXPECT_EQ(present(SIGHUP).sa_handler, SIG_IGN);
  EXPECT_EQ(present(SIGTERM).sa_handler, somebody_elses);
  EXPECT_EQ(present(SIGQUIT).sa_handler, somebody_elses);
  std::signal(SIGHUP, hangup);
  std::signal(SIGTERM, terminate);
  std::signal(SIGQUIT, SIG_DFL);
}

TEST(CrashStop, GivesTheThreadAStackForSignals) {
  std::thread([] {
    const CrashStop crash_stop;
    stack_t stack{};
    ASSERT_EQ(sigaltstack(nullptr, &stack), 0);
    EXPECT_EQ(stack.ss_flags & SS_DISABLE, 0);
    EXPECT_GE(stack.ss_size, static_cast<std::size_t>(MINSIGSTKSZ));
  }).join();
}

}  // namespace
}  // namespace hapticwall::session
