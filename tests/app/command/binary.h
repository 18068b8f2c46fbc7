// The real program in a folder of its own: arguments in, output and exit status out.
#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/inotify.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "tests/app/session/support.h"
#include "tests/paths.h"
#include "tests/temporary_folder.h"

namespace hapticwall::command::test {

using hapticwall::test::program;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

struct Answer {
  int status = -1;  // exit status; 128 + signal where one killed it
  std::string out;
  std::string err;

  [[nodiscard]] std::ptrdiff_t error_lines() const {
    return std::count(err.begin(), err.end(), '\n');
  }
};

class ProgramTest : public hapticwall::test::FolderTest {
 protected:
  // 0 where there is no such file.
  [[nodiscard]] std::uintmax_t size(const std::string& name) const {
    std::error_code missing;
    const std::uintmax_t bytes = std::filesystem::file_size(path(name), missing);
    return missing ? 0 : bytes;
  }
  // Names in the folder, except the helper's own.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names = folder_.names();
    std::erase(names, "stdout");
    std::erase(names, "stderr");
    return names;
  }

  // Replaces one piece of a file's text.
  void replace_in(const std::string& name, const std::string& piece, const std::string& by) const {
    std::string text = content(name);
    ASSERT_NE(text.find(piece), std::string::npos) << piece;
    put(name, text.replace(text.find(piece), piece.size(), by));
  }
  void remove_files() const {
    for (const std::string& name : files()) std::filesystem::remove(path(name));
  }

  // Starts a program in the folder, with output to "stdout" and "stderr" there.
  [[nodiscard]] pid_t start(std::vector<std::string> arguments) const {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder_.path().c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, path("stdout").c_str(), kWrite, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, path("stderr").c_str(), kWrite, 0600);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGINT);
    sigaddset(&defaults, SIGTERM);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t child = -1;
    const int code = posix_spawn(&child, argv[0], &actions, &attributes, argv.data(), environ);
    EXPECT_EQ(code, 0) << argv[0];
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return child;
  }

  [[nodiscard]] static bool is_running(pid_t child) {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == 0;
  }

  // Returns when `holds` or the program ends. The kernel reports every change of the folder, and
  // the end of the program.
  void wait_until(pid_t child, const std::function<bool()>& holds) const {
    const int folder = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
    const auto end = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
    EXPECT_GE(inotify_add_watch(folder, folder_.path().c_str(), IN_CREATE | IN_MODIFY | IN_MOVE),
              0);
    EXPECT_GE(end, 0);
    std::array<pollfd, 2> events{{{folder, POLLIN, 0}, {end, POLLIN, 0}}};
    std::array<char, 4096> changes{};
    while (is_running(child) && !holds()) {
      poll(events.data(), events.size(), -1);
      while (read(folder, changes.data(), changes.size()) > 0) {
      }
    }
    close(folder);
    close(end);
  }
  void wait_until_written(pid_t child, const std::string& name, std::uintmax_t bytes = 1) const {
    wait_until(child, [&] { return size(name) >= bytes; });
  }

  [[nodiscard]] Answer wait_for(pid_t child) const {
    int state = 0;
    EXPECT_EQ(waitpid(child, &state, 0), child);
    constexpr int kKilledBySignal = 128;
    return {WIFEXITED(state) ? WEXITSTATUS(state) : kKilledBySignal + WTERMSIG(state),
            content("stdout"), content("stderr")};
  }

  [[nodiscard]] Answer hapticwall(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return wait_for(start(std::move(arguments)));
  }

  // `signal` comes when the program has begun its first file: it catches signals before that.
  [[nodiscard]] Answer interrupted(std::vector<std::string> arguments, int signal) const {
    arguments.insert(arguments.begin(), program());
    const pid_t child = start(std::move(arguments));
    wait_until(child, [&] { return !files().empty(); });
    kill(child, signal);
    return wait_for(child);
  }

  // One SIGTERM, or another signal, once the program catches it and is `ready`. A program that does
  // not end fails the test.
  [[nodiscard]] Answer terminated(
      std::vector<std::string> arguments, const std::function<bool()>& ready = [] { return true; },
      int signal = SIGTERM) const {
    arguments.insert(arguments.begin(), program());
    const pid_t child = start(std::move(arguments));
    EXPECT_TRUE(session::test::eventually(
        [&] { return !is_running(child) || (catches(child, signal) && ready()); }));
    kill(child, signal);
    if (!session::test::eventually([&] { return !is_running(child); })) {
      ADD_FAILURE() << "the program does not end";
      kill(child, SIGKILL);
    }
    return wait_for(child);
  }

  // A line for a shell, in which $P is the program.
  [[nodiscard]] Answer shell(const std::string& line) const {
    return wait_for(start({"/bin/sh", "-c", "P='" + program() + "'; " + line}));
  }

 private:
  [[nodiscard]] static bool catches(pid_t child, int signal) {
    constexpr std::string_view kKey = "SigCgt:";
    const std::string status =
        hapticwall::test::text_of("/proc/" + std::to_string(child) + "/status");
    const std::size_t at = status.find(kKey);
    return at != std::string::npos &&
           (std::stoull(status.substr(at + kKey.size()), nullptr, 16) >> (signal - 1) & 1U) != 0;
  }

  static constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
};

}  // namespace hapticwall::command::test
