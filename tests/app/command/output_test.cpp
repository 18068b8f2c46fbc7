// Outputs to streams, and what ends a program that draws or that the system refuses resources.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

namespace fs = std::filesystem;

using OutputTest = ProgramTest;

TEST_F(OutputTest, StandardOutputByItsOtherNamesIsTheSameAsADash) {
  for (const std::string name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    const Answer answer = shell("echo before; $P compare light --json " + name);
    EXPECT_EQ(answer.status, 0) << answer.err;
    ASSERT_THAT(answer.out, StartsWith("before\n["));
    EXPECT_TRUE(nlohmann::json::accept(answer.out.substr(7)));
  }
  EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
}

TEST_F(OutputTest, AStreamIsWrittenAndNotReplaced) {
  const Answer answer = shell("$P run light --quiet --json /dev/stderr --plot /dev/fd/3 3>a.png");
  EXPECT_EQ(answer.status, 0);
  EXPECT_TRUE(nlohmann::json::accept(answer.err));
  EXPECT_THAT(content("a.png"), StartsWith("\x89PNG\r\n"));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const Answer piped = shell("cat pipe & $P run light --quiet --json pipe; wait");
  EXPECT_TRUE(nlohmann::json::accept(piped.out));
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_EQ(hapticwall({"run", "light", "--quiet", "--json", "/dev/null"}).status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

// A recording has a sidecar and is renamed.
TEST_F(OutputTest, ARecordingToAStreamIsRefused) {
  for (const std::string name : {"/dev/stdout", "/dev/stderr", "/dev/null"}) {
    const Answer answer = hapticwall({"run", "light", "--csv", name});
    EXPECT_EQ(answer.status, 4);
    EXPECT_EQ(answer.err,
              "error: " + name + ": cannot be written: it exists and is not a regular file\n");
  }
}

// The JSON is whole before the figure begins.
TEST_F(OutputTest, CtrlCEndsAFigureAtOnce) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child =
        start({program(), "compare", "press", "--json", "a.json", "--plot", "a.png"});
    wait_until_written(child, "a.json");
    kill(child, signal);
    const Answer answer = wait_for(child);
    EXPECT_EQ(answer.status, 128 + signal);
    EXPECT_THAT(answer.err, EndsWith("; the figure was not drawn\n"));
    EXPECT_EQ(answer.error_lines(), 1);
    EXPECT_THAT(files(), ElementsAre("a.json"));
    EXPECT_TRUE(nlohmann::json::accept(content("a.json")));
    remove_files();
  }
}

// A figure is drawn by Cairo.
TEST_F(OutputTest, AFigureNeedsNoOpenGl) {
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    const Answer answer = shell(
        std::string("export __EGL_VENDOR_LIBRARY_FILENAMES=/none LIBGL_DRIVERS_PATH=/none; exec $P "
                    "run press --duration 0.1 --quiet --plot ") +
        name);
    EXPECT_EQ(answer.status, 0) << answer.err;
  }
  EXPECT_THAT(files(), ElementsAre("a.pdf", "a.png", "a.svg"));
}

// The limits of a shell, and no signal.
TEST_F(OutputTest, ASmallStackIsRefusedInALine) {
  for (const std::string command : {"run press", "run press --realtime", "timing --seconds 0.1"}) {
    const Answer answer = shell("ulimit -s 128; exec $P " + command);
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.err,
              "error: the stack limit is 128 KiB, and the program needs 1024: 'ulimit -s 8192' "
              "raises it\n");
  }
}

// The program runs as another user with a limit on threads, because root has none.
TEST_F(OutputTest, MissingThreadsAreToldInALine) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to be a user without other processes";
  fs::permissions(path(""), fs::perms::all);
  for (const auto& [command, begin] :
       {std::pair<std::string, std::string>{"run press --realtime",
                                            "error: the loop did not start"},
        {"timing --seconds 0.1", "error: the system refused a thread"},
        {"run press --plot a.png", "error: the system refused a thread"}}) {
    const Answer answer = shell("exec setpriv --reuid 54321 --clear-groups prlimit --nproc=1 $P " +
                                command + " --quiet");
    EXPECT_THAT(answer.status, ::testing::AnyOf(2, 3)) << command;
    EXPECT_THAT(answer.err,
                AllOf(StartsWith(begin), HasSubstr("Resource temporarily unavailable")));
    EXPECT_EQ(answer.error_lines(), 1);
  }
}

// Slower, with the same cells.
TEST_F(OutputTest, AMapNeedsNoThreads) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to be a user without other processes";
  fs::permissions(path(""), fs::perms::all);
  for (const std::string limit :
       {"", "exec setpriv --reuid 54323 --clear-groups prlimit --nproc=1 "}) {
    for (const std::string command :
         {"map press --x wall.stiffness_n_per_m=1e3:1e4:5 --y wall.damping_n_s_per_m=0:1:3 --csv ",
          "compare tap --study --algorithms none,energy-bounding --csv "}) {
      const Answer answer =
          shell(std::string(limit).append("$P ").append(command).append(limit.empty() ? "a" : "b") +
                std::to_string(command.size()) + ".csv --quiet");
      EXPECT_EQ(answer.status, 0) << answer.err;
    }
  }
  const std::vector<std::string> written = folder_.names(".csv");
  ASSERT_EQ(written.size(), 4U);
  EXPECT_TRUE(content(written[0]) == content(written[2]));
  EXPECT_TRUE(content(written[1]) == content(written[3]));
}

// 10 000 changes are the documented limit; a parser would take half a gigabyte for a million.
TEST_F(OutputTest, ASidecarOfAMillionChangesTakesLittleMemory) {
  std::string text = "[device]\nmass_kg = 1\ndamping_n_s_per_m = 1\n[recording]\n";
  for (int i = 0; i < 1'000'000; ++i) text += "[[recording.change]]\ntick=1\n";
  put("a.toml", text);
  put("a.csv", "");
  const std::string limit = "ulimit -d " + std::to_string(4 * text.size() / 1024);
  for (const std::string command : {"run a.toml", "replay a.csv --quiet"}) {
    const Answer answer = shell(std::string(limit).append("; exec $P ").append(command));
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.error_lines(), 1);
  }
  EXPECT_THAT(shell(limit + "; exec $P run a.toml").err,
              HasSubstr("more than 10000 changes of parameters"));
}

}  // namespace
}  // namespace hapticwall::command::test
