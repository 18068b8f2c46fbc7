// hapticwall --stream: the samples on their way out of the program, and its three bridges.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/file/text/text.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

class StreamTest : public ProgramTest {
 protected:
  static std::vector<std::string> lines(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }
  // Each row of the CSV is an object, and the line at the end counts them.
  void expect_rows(const std::string& csv, const std::string& stream) const {
    const auto rows = lines(content(csv));
    const auto objects = lines(stream);
    ASSERT_EQ(objects.size(), rows.size());
    const auto names = file::split(rows.front(), ',');
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const nlohmann::json object = nlohmann::json::parse(objects[i - 1]);
      const auto values = file::split(rows[i], ',');
      ASSERT_EQ(object.size(), names.size() + 1);
      ASSERT_EQ(object.at("lost"), 0);
      for (std::size_t column = 0; column < names.size(); ++column) {
        ASSERT_EQ(object.at(names[column]).get<double>(), file::parsed<double>(values[column]));
      }
    }
    EXPECT_EQ(nlohmann::json::parse(objects.back()),
              (nlohmann::json{{"end", true}, {"samples", rows.size() - 1}, {"lost", 0}}));
  }
};

TEST_F(StreamTest, StandardOutputHasTheRowsOfTheCsvAndNothingElse) {
  for (const std::string how : {"", " --realtime"}) {
    const Answer answer = shell("$P run corner --duration 0.3 --csv a.csv --stream -" + how);
    EXPECT_EQ(answer.status, 0) << answer.err;
    EXPECT_THAT(answer.err, IsEmpty());
    expect_rows("a.csv", answer.out);
  }
}

TEST_F(StreamTest, ANewFileGetsThemBesideTheSummary) {
  const Answer answer = shell("$P run press --csv a.csv --stream a.jsonl");
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("press under"));
  expect_rows("a.csv", content("a.jsonl"));
}

TEST_F(StreamTest, AReplayStreamsItsRowsAndAReRunItsOwn) {
  ASSERT_EQ(shell("$P run press --csv a.csv --quiet").status, 0);
  expect_rows("a.csv", shell("$P replay a.csv --stream -").out);
  expect_rows("b.csv", shell("$P replay a.csv --algorithm none --csv b.csv --stream -").out);
}

// A run that is not in real time can wait.
TEST_F(StreamTest, ARunAsFastAsItCanWaitsForASlowReader) {
  const Answer answer = shell("$P run press --csv a.csv --stream - | (sleep 1.5; cat)");
  EXPECT_THAT(answer.err, IsEmpty());
  expect_rows("a.csv", answer.out);
}

TEST_F(StreamTest, AReaderThatClosesEndsTheStreamWithOneLineAndNotTheRun) {
  for (const std::string how : {"", " --realtime --duration 1"}) {
    const Answer answer =
        shell("{ $P run press --csv a.csv --stream -" + how + "; echo $? >status; } | head -n 1");
    EXPECT_EQ(answer.err, "--stream '-': the reader has closed it; the stream ends\n");
    EXPECT_EQ(content("status"), "0\n");
    EXPECT_EQ(lines(content("a.csv")).size(), how.empty() ? 6001U : 1001U);
  }
}

// The run ends by SIGPIPE and without a message, like every tool in a pipe. `timeout` ends a
// program that does not stop; it would run for days.
TEST_F(StreamTest, AReaderThatClosesEndsARunThatHasNoOtherOutput) {
  ASSERT_EQ(shell("$P run press --csv a.csv --quiet").status, 0);
  for (const std::string command :
       {"run press --duration 1e6", "run press --duration 1e6 --stream-every 1000000",
        "run tap --realtime --duration 1000", "replay a.csv", "replay a.csv --algorithm none"}) {
    const Answer answer = shell("{ timeout 60 $P " + command +
                                " --stream -; echo $? >status; } | head -n 3 | cut -c 1-9");
    EXPECT_EQ(answer.err, "") << command;
    EXPECT_EQ(content("status"), "141\n") << command;
    EXPECT_THAT(answer.out, StartsWith("{\"tick\":0")) << command;
    EXPECT_EQ(lines(answer.out).size(), 3U) << command;
  }
}

// The reader of a test: it reads when the test does.
class StreamReaderTest : public StreamTest {
 protected:
  StreamReaderTest() {
    EXPECT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    reader_ = open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  }
  ~StreamReaderTest() override { close(reader_); }

  // Returns when so many bytes wait in the pipe, or the program ends.
  void wait_for_bytes(pid_t child, int bytes) const {
    int waiting = 0;
    while (is_running(child) && waiting < bytes) {
      poll(nullptr, 0, 1);
      ASSERT_EQ(ioctl(reader_, FIONREAD, &waiting), 0);
    }
  }
  // Returns all bytes in the pipe.
  std::string drained() const {
    std::string text;
    std::array<char, 65536> bytes{};
    for (ssize_t count = 0; (count = read(reader_, bytes.data(), bytes.size())) > 0;)
      text.append(bytes.data(), static_cast<std::size_t>(count));
    return text;
  }
  [[nodiscard]] pid_t start_stream(const std::string& target) const {
    return start({program(), "run", "press", "--duration", "1e6", "--stream", target, "--quiet"});
  }

  int reader_ = -1;
};

TEST_F(StreamReaderTest, ASignalEndsARunThatWaitsForItsReader) {
  constexpr int kAlmostFull = 800'000;  // bytes, of 1 MiB with some room in each page
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start_stream("pipe");
    wait_for_bytes(child, kAlmostFull);
    kill(child, signal);
    const Answer answer = wait_for(child);
    EXPECT_EQ(answer.status, 128 + signal);
    EXPECT_THAT(answer.err, HasSubstr("ended early by"));
    const std::string text = drained();
    EXPECT_GT(text.size(), static_cast<std::size_t>(kAlmostFull));
    EXPECT_EQ(text.back(), '\n');
  }
}

// HAPTICWALL_KILLS kills as often, at more moments.
TEST_F(StreamReaderTest, AKillLeavesWholeLines) {
  const char* chosen = std::getenv("HAPTICWALL_KILLS");
  const std::uint64_t kills = file::parsed<std::uint64_t>(chosen ? chosen : "").value_or(10);
  for (std::uint64_t i = 0; i < kills; ++i) {
    const std::uintmax_t bytes = 1 + i * 104'729 % 900'000;
    pid_t child = start_stream("pipe");
    wait_for_bytes(child, static_cast<int>(bytes));
    kill(child, SIGKILL);
    ASSERT_EQ(wait_for(child).status, 128 + SIGKILL);
    ASSERT_EQ(drained().back(), '\n') << i;
    child = start_stream("a.jsonl");
    wait_until_written(child, "a.jsonl", bytes);
    kill(child, SIGKILL);
    ASSERT_EQ(wait_for(child).status, 128 + SIGKILL);
    ASSERT_EQ(content("a.jsonl").back(), '\n') << i;
    remove_files();
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    close(reader_);
    reader_ = open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  }
}

// Real time waits for nobody: buffer and pipe are full after a fraction of a second.
TEST_F(StreamReaderTest, ALossInRealTimeIsInTheSummaryAndFailsAnExpectation) {
  const std::string run =
      "$P run tap --realtime --set sampling.rate_hz=10000 --duration 1 --stream pipe --quiet "
      "--json a.json";
  const std::string loss = "samples were lost: the reader is too slow\n";
  Answer answer = shell(run);
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_THAT(answer.err, EndsWith(loss));
  drained();
  answer = shell(run + " --expect peak_force_n'>'=0");
  EXPECT_EQ(answer.status, 1);
  EXPECT_THAT(answer.err,
              HasSubstr("expected lost_stream_samples=0, found lost_stream_samples = "));
  const auto lost = nlohmann::json::parse(content("a.json")).at("lost_stream_samples");
  EXPECT_GT(lost, 1000);
  EXPECT_THAT(answer.err, HasSubstr(lost.dump() + " of 10000 " + loss));
  drained();
  EXPECT_EQ(shell(run + " --expect lost_stream_samples'>'1000").status, 0);
}

TEST_F(StreamTest, AFifoIsWrittenAndOneWithoutAReaderIsRefused) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const Answer refused = hapticwall({"run", "press", "--stream", "pipe", "--csv", "a.csv"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err, "error: --stream 'pipe': nobody reads it; start the reader first\n");
  EXPECT_THAT(files(), ElementsAre("pipe"));
  // `3<>` keeps it open until the program has it.
  const Answer answer = shell(
      "exec 3<>pipe; cat <pipe 3>&- & $P run press --csv a.csv --quiet --stream pipe; exec 3>&-; "
      "wait");
  expect_rows("a.csv", answer.out);
}

TEST_F(StreamTest, ASocketIsRefusedInItsOwnWords) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path("here").copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  const Answer answer = hapticwall({"run", "press", "--stream", "here"});
  close(descriptor);
  EXPECT_EQ(answer.status, 2);
  EXPECT_EQ(answer.err, "error: --stream 'here': it is a socket; use a pipe\n");
}

TEST_F(StreamTest, AFullDiskFailsTheRunAndKeepsTheRecording) {
  const Answer answer = hapticwall({"run", "press", "--csv", "a.csv", "--stream", "/dev/full"});
  EXPECT_EQ(answer.status, 4);
  EXPECT_THAT(answer.err, HasSubstr("--stream '/dev/full': No space left on device"));
  EXPECT_EQ(lines(content("a.csv")).size(), 6001U);
}

// The bridges of assets/examples/streams, with HAPTICWALL_PYTHON if it is set.
class StreamBridgeTest : public StreamTest {
 protected:
  static std::string bridge(const std::string& name) {
    const std::string folder = hapticwall::test::data_folder() + "/../assets/examples/streams/";
    return "'" + python() + "' '" + folder + name + "'";
  }
  static std::string python() {
    const char* chosen = std::getenv("HAPTICWALL_PYTHON");
    return chosen != nullptr ? chosen : "python3";
  }
  [[nodiscard]] bool can_import(const std::string& module) const {
    return shell("'" + python() + "' -c 'import " + module + "'").status == 0;
  }
};

constexpr const char* kNoPackage =
    "this package is missing; './dev test' installs it, or set HAPTICWALL_PYTHON";

TEST_F(StreamBridgeTest, PlotJugglerGetsADatagramASample) {
  if (!can_import("socket")) GTEST_SKIP() << "no Python";
  const int port = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof address;
  ASSERT_EQ(bind(port, reinterpret_cast<sockaddr*>(&address), length), 0);
  ASSERT_EQ(getsockname(port, reinterpret_cast<sockaddr*>(&address), &length), 0);
  const Answer answer =
      shell("$P run press --csv a.csv --stream - --stream-every 100 | " +
            bridge("to_plotjuggler.py") + " 127.0.0.1 " + std::to_string(ntohs(address.sin_port)));
  EXPECT_EQ(answer.status, 0) << answer.err;
  const auto rows = lines(content("a.csv"));
  std::size_t row = 1;
  std::array<char, 65536> bytes{};
  for (ssize_t size = 0; (size = recv(port, bytes.data(), bytes.size(), 0)) > 0; row += 100) {
    const nlohmann::json sample =
        nlohmann::json::parse(std::string_view(bytes.data(), static_cast<std::size_t>(size)));
    const auto values = file::split(rows.at(row), ',');
    EXPECT_EQ(sample.at("tick").get<double>(), file::parsed<double>(values[0]));
    EXPECT_EQ(sample.at("position_m").get<double>(), file::parsed<double>(values[2]));
    EXPECT_EQ(sample.at("force_n").get<double>(), file::parsed<double>(values[6]));
  }
  EXPECT_EQ(row, 6001U);
  close(port);
}

// An event among the samples, as the window writes it.
const std::string kEvent = R"(sed '3i {"event":"mark","tick":150,"time_s":0.15,"text":"here"}')";

TEST_F(StreamBridgeTest, AnMcapFileHasEverySample) {
  if (!can_import("mcap.reader")) GTEST_SKIP() << "mcap: " << kNoPackage;
  const Answer answer = shell("$P run press --csv a.csv --stream - --stream-every 100 | " + kEvent +
                              " | " + bridge("to_mcap.py") + " a.mcap");
  ASSERT_EQ(answer.status, 0) << answer.err;
  put("read.py",
      "from mcap.reader import make_reader\n"
      "for _, channel, message in make_reader(open('a.mcap', 'rb')).iter_messages():\n"
      "    print(channel.topic, message.log_time, message.data.decode().strip())\n");
  auto read = lines(shell("'" + python() + "' read.py").out);
  const auto rows = lines(content("a.csv"));
  ASSERT_EQ(read.size(), 61U);
  const std::string event = "/hapticwall/events 150000000 {\"event\":\"mark\",\"tick\":150,";
  const auto found =
      std::ranges::find_if(read, [&](const auto& line) { return line.starts_with(event); });
  ASSERT_NE(found, read.end());
  read.erase(found);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::string begin = "/hapticwall " + std::to_string(i * 100'000'000) + " ";
    ASSERT_THAT(read[i], StartsWith(begin));
    const nlohmann::json sample = nlohmann::json::parse(read[i].substr(begin.size()));
    EXPECT_EQ(sample.at("position_m").get<double>(),
              file::parsed<double>(file::split(rows.at(i * 100 + 1), ',')[2]));
  }
}

// The inlet compares by itself: liblsl gives it float64 as they were.
TEST_F(StreamBridgeTest, AnLslInletGetsEverySample) {
  if (!can_import("pylsl")) GTEST_SKIP() << "pylsl: " << kNoPackage;
  put("inlet.py",
      "import pylsl\n"
      "found = pylsl.resolve_byprop('source_id', 'test-' + open('id').read(), timeout=60)\n"
      "marks = pylsl.resolve_byprop('source_id', 'test-' + open('id').read() + '-events', "
      "timeout=60)\n"
      "marks = pylsl.StreamInlet(marks[0])\n"
      "marks.open_stream(timeout=60)\n"
      "inlet = pylsl.StreamInlet(found[0])\n"
      "info = inlet.info(timeout=60)\n"
      "channel = info.desc().child('channels').child('channel')\n"
      "names = []\n"
      "while not channel.empty():\n"
      "    names.append(channel.child_value('label'))\n"
      "    channel = channel.next_sibling()\n"
      "for _ in range(60):\n"
      "    values, _ = inlet.pull_sample(timeout=60)\n"
      "    print(*[repr(values[names.index(n)]) for n in ('tick', 'position_m', 'force_n')])\n"
      "print(marks.pull_sample(timeout=60)[0][0])\n");
  const Answer answer =
      shell("printf %s $$ >id; '" + python() +
            "' inlet.py & $P run press --csv a.csv --quiet --stream - " + "--stream-every 100 | " +
            kEvent + " | " + bridge("to_lsl.py") + " test-$(cat id) 60; wait");
  const auto read = lines(answer.out);
  const auto rows = lines(content("a.csv"));
  ASSERT_EQ(read.size(), 61U) << answer.err;
  EXPECT_EQ(read.back(), R"({"event":"mark","tick":150,"time_s":0.15,"text":"here"})");
  for (std::size_t i = 0; i < 60; ++i) {
    const auto wanted = file::split(rows.at(i * 100 + 1), ',');
    const auto values = file::split(read[i], ' ');
    EXPECT_EQ(file::parsed<double>(values.at(0)), file::parsed<double>(wanted[0]));
    EXPECT_EQ(file::parsed<double>(values.at(1)), file::parsed<double>(wanted[2]));
    EXPECT_EQ(file::parsed<double>(values.at(2)), file::parsed<double>(wanted[6]));
  }
}

}  // namespace
}  // namespace hapticwall::command::test
