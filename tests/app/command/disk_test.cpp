// Every output of every command on a full or removed disk: one line, exit status 4, no incomplete
// file under its final name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"
#include "tests/app/command/no_room.h"

namespace hapticwall::command::test {
namespace {

struct Output {
  const char* arguments;
  int blocks;        // max size of a file, in blocks of 512 bytes
  const char* file;  // that does not fit
  const char* left;  // the file that remains, or ""
};

constexpr const char* kMap =
    "map golden-soft --x wall.stiffness_n_per_m=100:3000:6:log --y device.damping_n_s_per_m="
    "0.1:0.7:4 --duration 0.2 --quiet ";
constexpr const char* kBoundary =
    "map golden-soft --boundary wall.stiffness_n_per_m=100:1e5:3:log --x "
    "device.damping_n_s_per_m=0.1:1:2 "
    "--duration 1 --quiet ";

class DiskTest : public ProgramTest {
 protected:
  void expect_not_written(const std::string& arguments, const Output& output) const {
    SCOPED_TRACE(arguments);
    const Answer answer =
        shell("ulimit -f " + std::to_string(output.blocks) + "; exec $P " + arguments);
    const std::string name = output.file;
    const std::string left = output.left;
    EXPECT_EQ(answer.status, 4);
    EXPECT_EQ(answer.err, "error: " + name + ": could not be written: File too large" +
                              (left.empty() ? "" : " (the written part is in " + left + ")") +
                              "\n");
    EXPECT_THAT(answer.out, IsEmpty());
    for (const std::string& found : files()) {
      EXPECT_TRUE(!left.empty() && found.ends_with(".partial")) << found;
      std::filesystem::remove(path(found));
    }
  }
  // Waits until the program has written a whole line to standard error.
  void wait_for_line(pid_t child) const {
    while (is_running(child) && !content("stderr").ends_with('\n')) sched_yield();
  }
  void wait_for_bytes(pid_t child, const std::string& name) const {
    while (is_running(child) && size(name) == 0) sched_yield();
  }
};

TEST_F(DiskTest, FullWhileAnOutputIsWritten) {
  for (const Output& output : {
           Output{"run press --quiet --csv a.csv", 8, "a.csv", "a.csv.partial"},
           Output{"run press --quiet --duration 0.001 --csv a.csv", 1, "a.toml.partial", ""},
           Output{"run press --quiet --json a.json", 1, "a.json", ""},
           Output{"run press --quiet --plot a.png", 8, "a.png", ""},
           Output{"run press --quiet --wav a.wav", 8, "a.wav", ""},
           Output{"compare press --quiet --csv a.csv", 1, "a.csv", ""},
           Output{"compare press --quiet --json a.json", 1, "a.json", ""},
           Output{"compare press --quiet --plot a.png", 8, "a.png", ""},
           Output{"compare press --quiet --study --csv a.csv", 1, "a.csv", ""},
           Output{"accuracy golden-soft --quiet --duration 0.1 --csv a.csv", 1, "a.csv", ""},
           Output{"accuracy golden-soft --quiet --duration 0.1 --json a.json", 1, "a.json", ""},
           Output{"accuracy golden-soft --quiet --duration 0.1 --plot a.png", 8, "a.png", ""},
           Output{"timing --quiet --seconds 0.01 --json a.json", 1, "a.json", ""},
       }) {
    expect_not_written(output.arguments, output);
  }
}

TEST_F(DiskTest, FullWhileAMapIsWritten) {
  for (const Output& output :
       {Output{"--csv m.csv", 4, "m.csv", "m.csv.partial"},
        Output{"--json m.json", 1, "m.json", ""}, Output{"--plot m.png", 8, "m.png", ""}}) {
    expect_not_written(std::string(kMap) + output.arguments, output);
  }
  for (const Output& output :
       {Output{"--csv b.csv", 1, "b.csv", ""}, Output{"--json b.json", 1, "b.json", ""}}) {
    expect_not_written(std::string(kBoundary) + output.arguments, output);
  }
}

// A later run resumes from the rows before the disk error.
TEST_F(DiskTest, AMapThatFoundNoRoomIsGoneOnWith) {
  ASSERT_EQ(shell("ulimit -f 4; exec $P " + std::string(kMap) + "--csv m.csv").status, 4);
  const std::string left = content("m.csv.partial");
  EXPECT_EQ(left.size(), 4U * 512U);
  if (kStartsWithoutRoom) {
    EXPECT_EQ(shell(std::string(kNoRoom) + kMap + "--csv m.csv").status, 4);
  }
  ASSERT_EQ(shell("exec $P " + std::string(kMap) + "--csv m.csv").status, 0);
  EXPECT_THAT(content("m.csv"), StartsWith(left));
}

// The other outputs of a run do not depend on its recording, nor on each other.
TEST_F(DiskTest, AFullDiskOfOneOutputCostsNoOther) {
  const std::string full =
      "error: a.csv: could not be written: File too large (the written part is in "
      "a.csv.partial)\n";
  for (const std::string command : {"run press", "run press --realtime --duration 1.5"}) {
    const Answer answer = shell("ulimit -f 8; exec $P " + command + " --csv a.csv --json a.json");
    EXPECT_EQ(answer.status, 4);
    EXPECT_THAT(answer.err, EndsWith(full));
    EXPECT_THAT(answer.out, StartsWith("press under energy-bounding: "));
    EXPECT_THAT(content("a.json"), HasSubstr("\"verdict\": "));
    EXPECT_THAT(files(), ElementsAre("a.csv.partial", "a.json", "a.toml.partial"));
    remove_files();
  }
  ASSERT_EQ(hapticwall({"run", "press", "--csv", "b.csv", "--quiet"}).status, 0);
  const Answer rerun =
      shell("ulimit -f 8; exec $P replay b.csv --algorithm none --quiet --csv a.csv --json a.json");
  EXPECT_EQ(rerun.status, 4);
  EXPECT_EQ(rerun.err, full);
  EXPECT_THAT(content("a.json"), HasSubstr("\"algorithm\": \"none\""));
  const Answer compared = hapticwall({"compare", "press", "--csv", "/dev/full", "--json", "-"});
  EXPECT_EQ(compared.status, 4);
  EXPECT_EQ(compared.err, "error: /dev/full: could not be written: No space left on device\n");
  EXPECT_THAT(compared.out, StartsWith("[\n"));
}

TEST_F(DiskTest, AFullDiskIsToldWhileARunInRealTimeGoesOn) {
  const pid_t child = start({"/bin/sh", "-c",
                             "ulimit -f 8; exec '" + program() +
                                 "' run press --realtime --duration 1000 --csv a.csv --quiet"});
  wait_for_line(child);
  EXPECT_TRUE(is_running(child));
  kill(child, SIGINT);
  const Answer answer = wait_for(child);
  EXPECT_EQ(answer.status, 4);
  const std::string what =
      "a.csv: could not be written: File too large (the written part is in a.csv.partial)";
  EXPECT_EQ(answer.err, what + "; the run continues\nerror: " + what + "\n");
  EXPECT_EQ(size("a.csv.partial"), 8U * 512U);
  EXPECT_EQ(size("a.csv") + size("a.toml"), 0U);
  ASSERT_EQ(hapticwall({"recover", "a.csv"}).status, 0);
}

TEST_F(DiskTest, AFolderThatIsRemovedIsToldAtOnceInRealTimeElseAtTheEnd) {
  for (const bool in_real_time : {false, true}) {
    std::filesystem::create_directory(path("sub"));
    std::vector<std::string> arguments{program(), "run",   "press",     "--duration",
                                       "100000",  "--csv", "sub/a.csv", "--quiet"};
    if (in_real_time) arguments.emplace_back("--realtime");
    const pid_t child = start(arguments);
    wait_for_bytes(child, "sub/a.csv.partial");
    std::filesystem::remove_all(path("sub"));
    if (in_real_time) wait_for_line(child);
    EXPECT_TRUE(is_running(child));
    kill(child, SIGINT);
    const Answer answer = wait_for(child);
    EXPECT_EQ(answer.status, 4);
    EXPECT_THAT(answer.err,
                EndsWith("error: sub/a.csv: could not be written: sub/a.csv.partial was "
                         "removed during the writing\n"));
    EXPECT_THAT(files(), IsEmpty());
  }
}

TEST_F(DiskTest, AFolderThatIsMovedKeepsTheRowsForRecovery) {
  std::filesystem::create_directory(path("sub"));
  const pid_t child =
      start({program(), "run", "press", "--duration", "100000", "--csv", "sub/a.csv", "--quiet"});
  wait_for_bytes(child, "sub/a.csv.partial");
  std::filesystem::rename(path("sub"), path("moved"));
  kill(child, SIGINT);
  const Answer answer = wait_for(child);
  EXPECT_EQ(answer.status, 4);
  EXPECT_EQ(
      answer.err,
      "error: sub/a.csv: could not be written: sub/a.csv.partial was moved during the writing\n");
  const Answer recovered = hapticwall({"recover", "moved/a.csv"});
  EXPECT_EQ(recovered.status, 0) << recovered.err;
  EXPECT_THAT(recovered.out, AllOf(StartsWith("moved/a.csv: "), HasSubstr(" rows")));
  EXPECT_EQ(hapticwall({"run", "moved/a.toml", "--quiet"}).status, 0);
}

// The test also holds for root, who ignores permissions.
TEST_F(DiskTest, ReadOnlyFoldersAreToldBeforeAnythingRuns) {
  for (const std::string option : {"--csv", "--json", "--plot", "--wav"}) {
    const Answer answer =
        hapticwall({"run", "press", "--duration", "600", option, "/sys/hapticwall"});
    EXPECT_EQ(answer.status, 4);
    EXPECT_THAT(answer.err, StartsWith("error: /sys/hapticwall: cannot be written: "));
    EXPECT_EQ(answer.error_lines(), 1);
  }
  const Answer answer = hapticwall({"run", "press", "--realtime", "--csv", "/sys/hapticwall.csv"});
  EXPECT_EQ(answer.status, 4);
  EXPECT_EQ(answer.error_lines(), 1);
}

}  // namespace
}  // namespace hapticwall::command::test
