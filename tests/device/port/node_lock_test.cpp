// The lock of a device's node between real processes, on a file and on a character device.
#include "device/port/node_lock.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

namespace hapticwall::device::hid {
namespace {

// A second host: a process that takes the lock and keeps it until it is killed.
class OtherHost {
 public:
  explicit OtherHost(const std::string& node) {
    int pipe_ends[2];
    EXPECT_EQ(::pipe(pipe_ends), 0);
    process_ = ::fork();
    if (process_ == 0) hold(node, pipe_ends[1]);
    ::close(pipe_ends[1]);
    char word = 'n';
    EXPECT_EQ(::read(pipe_ends[0], &word, 1), 1);
    ::close(pipe_ends[0]);
    has_it = word == 'y';
  }
  ~OtherHost() { die(); }
  void die() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }
  [[nodiscard]] std::string process() const { return std::to_string(process_); }

  bool has_it = false;

 private:
  [[noreturn]] static void hold(const std::string& node, int answer) {
    const auto lock = NodeLock::take(node, node);
    static_cast<void>(::write(answer, lock ? "y" : "n", 1));
    while (true) ::pause();
  }

  pid_t process_ = 0;
};

std::string own_name() {
  std::string name;
  std::ifstream comm("/proc/self/comm");
  std::getline(comm, name);
  return name;
}

void expect_one_host(const std::string& node) {
  {
    OtherHost other(node);
    ASSERT_TRUE(other.has_it);
    for (int attempt = 0; attempt < 3; ++attempt) {
      const auto refused = NodeLock::take(node, "PATH");
      ASSERT_FALSE(refused);
      EXPECT_EQ(refused.error().kind, ErrorKind::kDevice);
      EXPECT_EQ(refused.error().message, "PATH is in use by " + own_name() + " (process " +
                                             other.process() + "): end that session first");
    }
    EXPECT_FALSE(OtherHost(node).has_it) << "a refusal takes no lock away";
    other.die();  // as by kill -9
    EXPECT_TRUE(NodeLock::take(node, "PATH")) << "the kernel releases the lock of the dead";
  }
  auto lock = NodeLock::take(node, "PATH");
  ASSERT_TRUE(lock);
  ::close(::open(node.c_str(), O_RDONLY | O_NOCTTY));  // a POSIX lock would be gone now
  EXPECT_FALSE(OtherHost(node).has_it);
  lock->reset();
  EXPECT_TRUE(OtherHost(node).has_it);
}

TEST(NodeLock, KeepsAnotherProcessOffAFileAndNamesItself) {
  const hapticwall::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "node").string();
  std::ofstream(file) << "";
  expect_one_host(file);
}

TEST(NodeLock, KeepsAnotherProcessOffACharacterDevice) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(::unlockpt(terminal), 0);
  char node[64];
  ASSERT_EQ(::ptsname_r(terminal, node, sizeof node), 0);
  ASSERT_TRUE(std::filesystem::is_character_file(node));
  expect_one_host(node);
  ::close(terminal);
}

TEST(NodeLock, IsOfOneNodeNotOfItsName) {
  const hapticwall::test::TemporaryFolder folder;
  const std::string file = (folder.path() / "node").string();
  std::ofstream(file) << "";
  const auto lock = NodeLock::take(file, file);
  ASSERT_TRUE(lock);
  EXPECT_TRUE((*lock)->is_of(file));
  std::filesystem::remove(file);
  EXPECT_FALSE((*lock)->is_of(file));
  std::ofstream(file) << "";  // plugged in again
  EXPECT_FALSE((*lock)->is_of(file));
  EXPECT_TRUE(NodeLock::take(file, file));
}

TEST(NodeLock, ANodeThatDoesNotOpenSaysWhy) {
  const auto lock = NodeLock::take("/dev/there-is-no-such-device", "PATH");
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().message, "PATH cannot be opened: No such file or directory");
}

}  // namespace
}  // namespace hapticwall::device::hid
