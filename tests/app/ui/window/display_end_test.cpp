// A display server that dies under a pushing device: zero force first, then the recording.
#include "app/ui/window/display_end.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

#include "app/file/recording/recording_reader.h"
#include "app/ui/window/application.h"
#include "tests/app/ui/display.h"
#include "tests/app/ui/window/pushing_window.h"

namespace hapticwall::ui {
namespace {

using session::test::eventually;
using session::test::Shared;
using test::PushingWindow;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kFolderVariable = "HAPTICWALL_TEST_FOLDER";
constexpr int kDisplayStatus = 5;

// An X server of this process alone, which becomes its display. It ends with its last client.
class OwnServer {
 public:
  OwnServer() {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return;
    start(ends[1]);
    close(ends[1]);
    std::string number;
    for (char digit = 0; read(ends[0], &digit, 1) == 1 && digit != '\n';) number += digit;
    close(ends[0]);
    setenv("DISPLAY", (":" + number).c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
  }
  void die() const {
    kill(server_, SIGKILL);
    waitpid(server_, nullptr, 0);
  }

 private:
  void start(int number_end) {
    std::string descriptor = std::to_string(number_end);
    std::array<std::string, 4> words{"Xvfb", "-terminate", "-displayfd", descriptor};
    std::array<char*, 5> argv{words[0].data(), words[1].data(), words[2].data(), words[3].data()};
    posix_spawn_file_actions_t silent;
    posix_spawn_file_actions_init(&silent);
    posix_spawn_file_actions_addopen(&silent, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (posix_spawnp(&server_, argv[0], &silent, nullptr, argv.data(), environ) != 0) server_ = -1;
    posix_spawn_file_actions_destroy(&silent);
  }

  pid_t server_ = -1;
};

// Opens the window on a server of its own; after a hundred recorded rows `lose` is called.
[[noreturn]] void lose_the_display(Shared& heard, const std::string& csv,
                                   const std::function<void(const OwnServer&)>& lose) {
  const OwnServer server;
  PushingWindow window(heard);
  window.hooks.opened = [&](Application& application) {
    session::LiveSession& session = *application.live();
    if (session.start_recording(csv)) _exit(1);
    if (!eventually([&] { return session.recording_status().rows >= 100; })) _exit(1);
  };
  window.in_a_panel = [&] { lose(server); };
  static_cast<void>(run_window(window.options, window.hooks));
  _exit(session::test::kAlive);
}

// A new process repeats this test up to its death; it gets the folder by the environment.
class DisplayEndTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_display()) GTEST_SKIP() << "no display";
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    if (const char* known = std::getenv(kFolderVariable)) {
      csv_ = known;
      return;
    }
    folder_ = std::make_unique<TemporaryFolder>();
    csv_ = folder_->file("a.csv");
    setenv(kFolderVariable, csv_.c_str(), 1);
  }
  void TearDown() override {
    if (folder_) unsetenv(kFolderVariable);
  }
  void expect_safe_end() const {
    PushingWindow(heard_).expect_safe_end();
    const auto reader = file::RecordingReader::open(csv_);
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    const file::ScannedRows& scanned = (*reader)->info().scanned;
    EXPECT_GE(scanned.rows, 100U);
    EXPECT_EQ(scanned.missing_rows, 0U);
    EXPECT_TRUE((*reader)->info().notes.empty());
  }

  mutable Shared heard_{"HAPTICWALL_TEST_HEARD"};
  std::string csv_;
  std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(DisplayEndTest, AServerThatDiesTakesTheForceAwayAndFinishesTheRecording) {
  EXPECT_EXIT(
      lose_the_display(heard_, csv_, [](const OwnServer& server) { server.die(); }),
      ::testing::ExitedWithCode(kDisplayStatus),
      AllOf(HasSubstr("error: the display server ended the connection;"),
            EndsWith("; the force is off, and the recording is kept\n"), Not(HasSubstr("XIO"))));
  expect_safe_end();
}

// A window that does not exist is brought up.
void ask_for_nonsense(const OwnServer& /*server*/) {
  const auto function = [](const char* name) { return dlsym(RTLD_DEFAULT, name); };
  void* display = reinterpret_cast<void* (*)()>(function("glfwGetX11Display"))();
  reinterpret_cast<int (*)(void*, unsigned long)>(function("XMapWindow"))(display, 1);
  reinterpret_cast<int (*)(void*, int)>(function("XSync"))(display, 0);
}

TEST_F(DisplayEndTest, ARefusedRequestDoesTheSame) {
  EXPECT_EXIT(lose_the_display(heard_, csv_, ask_for_nonsense),
              ::testing::ExitedWithCode(kDisplayStatus),
              HasSubstr("error: the display server refused a request;"));
  expect_safe_end();
}

}  // namespace
}  // namespace hapticwall::ui
