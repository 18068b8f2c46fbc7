// Boards that speak a dialect, on the bus of a real kernel and in real time, driven by the shipped
// program. tests/hid_guest runs it in a guest, where the program is in the PATH.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/device/emulator/emulator_support.h"
#include "tests/device/port/foreign_board.h"
#include "tests/emulator/firmware/uhid_device.h"
#include "tests/temporary_folder.h"

namespace hapticwall::device::hid::testing {
namespace {

using ::hapticwall::test::TemporaryFolder;
using ::hapticwall::test::text_of;
using ::testing::HasSubstr;

constexpr double kWallM = 0.05;
constexpr double kWallNPerM = 600.0;

// Descriptor as the firmware of an mbed describes itself; with ids, as one of numbered reports.
Bytes raw_descriptor(std::size_t in_bytes, std::size_t out_bytes, bool numbered) {
  Bytes bytes{0x06, 0xAB, 0xFF, 0x0A, 0x00, 0x02, 0xA1, 0x01,
              0x75, 0x08, 0x15, 0x00, 0x26, 0xFF, 0x00};
  const auto add = [&](std::uint8_t id, std::size_t count, std::uint8_t item) {
    if (numbered) bytes.insert(bytes.end(), {0x85, id});
    const auto size = static_cast<std::uint8_t>(count);
    bytes.insert(bytes.end(), {0x95, size, 0x09, id, item, 0x02});
  };
  add(1, in_bytes, 0x81);
  add(2, out_bytes, 0x91);
  bytes.push_back(0xC0);
  return bytes;
}

// A hand that comes 20 mm behind the face of the wall, and stays there.
Scene pressing_scene() {
  Scene scene = held_scene();
  scene.x().device.encoder_m = 1e-6;  // the board counts
  scene.x().hand->path = {{0.0, 0.03}, {1.5, 0.03}, {1.9, 0.07}};
  return scene;
}

// The program with these arguments; what it says goes into a file.
class Program {
 public:
  Program(std::vector<std::string> words, const std::string& said) {
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    words.insert(words.begin(), "hapticwall");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (posix_spawnp(&pid_, "hapticwall", &actions, nullptr, arguments.data(), environ) != 0)
      pid_ = 0;
    posix_spawn_file_actions_destroy(&actions);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (!ended()) kill();
    while (!ended()) usleep(1000);
  }

  bool ended() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
    return pid_ == 0;
  }
  void kill() const { ::kill(pid_, SIGKILL); }
  [[nodiscard]] int status() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

 private:
  pid_t pid_ = 0;
  int status_ = -1;
};

// A board in the time of this machine.
class KernelBoard {
 public:
  KernelBoard(ForeignBoard& board, const HidIdentity& identity) : board_(board) {
    auto bus = open_uhid(identity);
    EXPECT_TRUE(bus) << bus.error().message;
    bus_ = std::move(*bus);
    EXPECT_FALSE(bus_->plug());
    next_ns_ = bus_->now_ns();
  }

  // Ticks until a condition holds, for at most `at_most_ms`; returns whether it holds.
  bool until(const std::function<bool()>& holds, int at_most_ms) {
    for (int i = 0; i < at_most_ms && !holds(); ++i) tick();
    return holds();
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  void unplug() { bus_->unplug(); }

  double peak_n = 0.0;  // of either sign
  std::uint64_t last_force_ms = 0;

 private:
  void tick() {
    next_ns_ += 1'000'000;
    while (bus_->now_ns() < next_ns_) {
      bus_->wait_until_ns(next_ns_);
      while (const auto request = bus_->next_request()) {
        if (request->kind == RequestKind::kOutput) board_.take(request->bytes);
      }
    }
    for (const Bytes& report : board_.tick()) bus_->send(report);
    const double force_n = std::abs(board_.force_n());
    peak_n = std::max(peak_n, force_n);
    if (force_n > 0.0) last_force_ms = board_.now_ms;
  }

  ForeignBoard& board_;
  std::unique_ptr<VirtualBus> bus_;
  std::int64_t next_ns_ = 0;
};

// A kind of board, its file, and what its firmware ends a force after, ms; 0: never.
struct BoardKind {
  std::string name;
  std::function<std::unique_ptr<ForeignBoard>()> make;
  HidIdentity identity;
  Bytes descriptor;
  std::uint64_t watchdog_ms;
};

template <class Board>
std::unique_ptr<ForeignBoard> made() {
  return std::make_unique<Board>(pressing_scene());
}

BoardKind polhem() {
  return {"polhem-v1",
          made<PolhemBoard>,
          {0x1234, 0x0006, "1", "mbed", {}},
          raw_descriptor(14, 14, false),
          MbedBoard::kWatchdogMs};
}
BoardKind wooden() {
  return {"woodenhaptics",
          made<WoodenBoard>,
          {0x1234, 0x0006, "1", "mbed", {}},
          raw_descriptor(8, 8, false),
          MbedBoard::kWatchdogMs};
}
BoardKind knob() {
  return {"knob.toml",
          made<FloatKnob>,
          {0x1209, 0x0002, "1", "knob", {}},
          raw_descriptor(16, 16, true),
          0};
}

class KernelBoardTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("HAPTICWALL_GUEST") == nullptr)  // NOLINT(concurrency-mt-unsafe)
      GTEST_SKIP() << "it needs /dev/uhid, and a machine that does nothing else";
    const sched_param parameters{81};  // a device does not wait for the loop
    ASSERT_EQ(sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters), 0);
  }
  void plug(BoardKind kind) {
    kind_ = std::move(kind);
    kind_.identity.descriptor = kind_.descriptor;
    board_ = kind_.make();
    bus_.emplace(*board_, kind_.identity);
  }
  // A session by the file of the board, or by another one.
  void begin(const std::string& file = "") {
    const std::string path = (file.empty() ? kind_.name : file);
    const bool own = path.ends_with(".toml");
    if (own) folder_.put(path, FloatKnob::kFile);
    program_.emplace(
        std::vector<std::string>{
            "run", "press", "--device", "ie2000:" + (own ? folder_.file(path) : path), "--arm",
            "--algorithm", "none", "--set", "wall.stiffness_n_per_m=" + std::to_string(kWallNPerM),
            "--duration", "3"},
        folder_.file("said"));
  }
  // Into the wall, and at rest there: the wall pushes out of it, as strongly as it is deep.
  void press() {
    ASSERT_TRUE(bus_->until([&] { return board_->force_n() < -3.0; }, 6000)) << said();
    bus_->ticks(400);
    const double depth_m = board_->plant.truth().position_m - kWallM;
    pressed_n_ = board_->force_n();
    EXPECT_NEAR(pressed_n_, -kWallNPerM * depth_m, 0.05);
    EXPECT_NEAR(pressed_n_, -250.0 * (0.02 - depth_m), 0.1);  // the hand
    EXPECT_LT(bus_->peak_n, 5.0);
  }
  void wait_for_its_end() {
    ASSERT_TRUE(bus_->until([&] { return program_->ended(); }, 8000)) << said();
  }
  [[nodiscard]] std::string said() const { return text_of(folder_.file("said")); }

  TemporaryFolder folder_;
  BoardKind kind_;
  std::unique_ptr<ForeignBoard> board_;
  std::optional<KernelBoard> bus_;
  std::optional<Program> program_;
  double pressed_n_ = 0.0;
};

class EachKernelBoard : public KernelBoardTest, public ::testing::WithParamInterface<int> {
 protected:
  static BoardKind kind() {
    return std::vector{polhem, wooden, knob}.at(static_cast<std::size_t>(GetParam()))();
  }
};
INSTANTIATE_TEST_SUITE_P(Boards, EachKernelBoard, ::testing::Values(0, 1, 2));

TEST_P(EachKernelBoard, IsPushedOutOfTheWallAndReleased) {
  plug(kind());
  begin();
  press();
  wait_for_its_end();
  EXPECT_EQ(program_->status(), 0) << said();
  EXPECT_EQ(board_->force_n(), 0.0);
  const auto ended_ms = board_->now_ms;
  bus_->ticks(600);
  EXPECT_LT(bus_->last_force_ms, ended_ms);
  EXPECT_TRUE(std::all_of(board_->written.back().begin() + 1, board_->written.back().end(),
                          [](auto byte) { return byte == 0; }));
  std::cout << kind_.name << ": " << pressed_n_ << " N, then 0; " << board_->written.size()
            << " reports written\n";
}

// Nothing is left that could send a zero. docs/dialects.md: use no device without a watchdog.
TEST_P(EachKernelBoard, KeepsItsForceAfterAKillUntilItsWatchdogEndsIt) {
  plug(kind());
  begin();
  press();
  const std::uint64_t killed_ms = board_->now_ms;
  program_->kill();
  wait_for_its_end();
  EXPECT_NE(board_->force_n(), 0.0);
  bus_->ticks(1000);
  if (kind_.watchdog_ms == 0) {
    EXPECT_NE(board_->force_n(), 0.0);
    return;
  }
  EXPECT_EQ(board_->force_n(), 0.0);
  EXPECT_GE(bus_->last_force_ms + 12, killed_ms + kind_.watchdog_ms);
  EXPECT_LE(bus_->last_force_ms, killed_ms + kind_.watchdog_ms);
  std::cout << kind_.name << ": " << pressed_n_ << " N for " << bus_->last_force_ms - killed_ms
            << " ms after kill -9\n";
}

TEST_P(EachKernelBoard, UnpluggedEndsTheSession) {
  plug(kind());
  begin();
  press();
  bus_->unplug();
  wait_for_its_end();
  EXPECT_EQ(program_->status(), 3);
  EXPECT_THAT(said(), HasSubstr("unplugged"));
}

// Both boards have the numbers of mbed's examples.
TEST_F(KernelBoardTest, IsNeverPushedByTheFileOfAnotherBoard) {
  plug(wooden());
  begin("polhem-v1");
  wait_for_its_end();
  EXPECT_EQ(program_->status(), 3);
  EXPECT_THAT(said(), HasSubstr("none has the length and id of its file"));
  EXPECT_EQ(bus_->peak_n, 0.0);
}

}  // namespace
}  // namespace hapticwall::device::hid::testing
