// No allocation, no lock and no system call inside a cycle: counted over every algorithm, switch,
// command, parameter change, change of plant and record push, and once more in a child process
// which the kernel kills at its first system call.
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "device/simulated_device.h"
#include "tests/app/session/loop/interposition.h"
#include "tests/app/session/loop/loop_bench.h"
#include "tests/app/session/support.h"

#if HAPTICWALL_INTERPOSITION  // a sanitizer allocates and calls the system as it likes

namespace hapticwall::session {
namespace {

using test::CallWatch;
using test::contact_scene;
using test::WatchedCalls;

constexpr std::size_t kCyclesPerLeg = 300;

// A plant of every kind: hand or none, grip or none, friction and encoder or none.
std::vector<Scene> scenes() {
  Scene rigid = contact_scene();
  rigid.x().hand->grip_stiffness_n_per_m.reset();
  rigid.x().hand->grip_damping_n_s_per_m.reset();
  Scene frictionless = contact_scene();
  frictionless.x().device.friction_n.reset();
  frictionless.x().device.encoder_m.reset();
  Scene free = contact_scene();
  free.x().hand.reset();
  free.x().device.start_m = 0.06;
  return {contact_scene(), rigid, frictionless, free};
}

// Plants of all types, several times, mostly with changes of integrator and parts between them.
std::vector<Scene> plant_kinds(const Scene& scene) {
  constexpr int kKinds = 24;
  constexpr int kStep = 7;  // no divisor of the kinds: all are met
  std::vector<Scene> kinds;
  for (int i = 0; i < 2 * kKinds; ++i) {
    const int kind = (i * kStep + i / kKinds) % kKinds;
    Scene& next = kinds.emplace_back(scene);
    const auto integrator = static_cast<Integrator>(kind % 3);
    next.simulator = {integrator, integrator == Integrator::kExact ? 1 : 1 + i % 3};
    next.x().device.friction_n = (kind / 3) % 2 == 0 ? 0.0 : 0.2;
    next.x().device.amplifier_time_constant_s = (kind / 6) % 2 == 0 ? 0.0 : 1e-3;
    next.x().device.delay_ticks = i % 5;
    next.x().device.force_resolution_n = 0.01 * (i % 2);
    next.x().device.encoder_m = 1e-4 * (i % 3);
    next.x().device.mass_kg = 0.05 + 0.01 * i;
    if (!next.x().hand) continue;
    next.x().hand->mass_kg = 0.4;
    next.x().hand->grip_stiffness_n_per_m.reset();
    next.x().hand->grip_damping_n_s_per_m.reset();
    if (kind / 12 == 1) next.x().hand->grip_stiffness_n_per_m = 1000.0;
  }
  return kinds;
}

// A loop with a script of everything that happens in a session.
struct ScriptedLoop : test::LoopBench<device::SimulatedDevice> {
  explicit ScriptedLoop(const Scene& first) : LoopBench(first, false, {.plot = 1000}, first) {
    Scene changed = first;
    for (std::size_t from = 0; from < algorithms().size(); ++from) {
      for (std::size_t to = 0; to < algorithms().size(); ++to) {
        for (const std::size_t index : {from, to}) {
          changed.algorithm.index = index;
          changed.x().walls[0].stiffness_n_per_m = 20'000.0 + 1000.0 * static_cast<double>(to);
          add(changed, nullptr);
        }
      }
    }
    for (const Scene& kind : plant_kinds(changed)) {
      plants.push_back(std::make_unique<PlantModel>(kind));
      add(kind, plants.back().get());
    }
  }

  void add(const Scene& changed, PlantModel* plant) {
    parameters.push_back(
        test::parameters_of(changed, static_cast<std::uint32_t>(parameters.size() + 2), plant));
  }

  void cycles(int count) {
    LoopBench::cycles(count);
    ParameterEcho echo;
    while (exchange.echoes.try_pop(echo)) newest_generation = echo.generation;
  }

  void run() {
    command(CommandKind::kStartRecording);
    exchange.sound->wanted = true;  // nobody reads it: both ends of its branch run
    for (const LoopParameters& changed : parameters) {
      exchange.parameters.publish(changed);
      cycles(kCyclesPerLeg);
    }
    ASSERT_TRUE(exchange.hand_moves.try_push({.m = {0.005}, .duration_s = 0.2}));
    ASSERT_TRUE(exchange.hand_moves.try_push({.m = {-0.005}, .duration_s = 0.01}));
    cycles(kCyclesPerLeg);
    cycles(kCyclesPerLeg);
    command(CommandKind::kPause);
    command(CommandKind::kStep, static_cast<std::uint32_t>(kCyclesPerLeg / 2));
    cycles(kCyclesPerLeg);
    command(CommandKind::kReset);
    command(CommandKind::kResume);
    cycles(kCyclesPerLeg);
    command(CommandKind::kStopRecording);
    cycles(1);
    exchange.snapshots.update();
  }

  // Guards against a run that exercises nothing.
  [[nodiscard]] bool did_everything() const {
    const auto ticks = parameters.size() * kCyclesPerLeg + 3 * kCyclesPerLeg + kCyclesPerLeg / 2;
    return exchange.snapshots.current().timing.ticks == ticks + 1 &&
           exchange.recorder.size() == ticks && exchange.dropped_rows == 0 &&
           exchange.dropped_plot_samples > 0 && newest_generation == parameters.back().generation &&
           exchange.recording_switches == 2;
  }

  std::vector<std::unique_ptr<PlantModel>> plants;
  std::vector<LoopParameters> parameters;
  std::uint32_t newest_generation = 0;
};

TEST(CyclePurity, NoAllocationAndNoLock) {
  for (const Scene& scene : scenes()) {
    const auto session = std::make_unique<ScriptedLoop>(scene);
    CallWatch watch;
    session->run();
    const WatchedCalls calls = watch.calls();
    EXPECT_EQ(calls.allocations, 0U);
    EXPECT_EQ(calls.frees, 0U);
    EXPECT_EQ(calls.locks, 0U);
    EXPECT_TRUE(session->did_everything());
  }
}

// Prevents Clang from removing an unused allocation.
void keep(void* memory) { asm volatile("" : : "r"(memory) : "memory"); }

// The watch detects violations.
TEST(CyclePurity, TheWatchCountsAllocationsAndLocks) {
  std::mutex mutex;
  CallWatch watch;
  {
    const auto number = std::make_unique<int>(1);
    keep(number.get());
    const std::scoped_lock lock(mutex);
  }
  const std::unique_ptr<void, decltype(&std::free)> zeros(std::calloc(1, 1), &std::free);
  keep(zeros.get());
  const WatchedCalls calls = watch.calls();
  EXPECT_EQ(calls.allocations, 2U);
  EXPECT_EQ(calls.frees, 1U);
  EXPECT_EQ(calls.locks, 1U);
}

// From here on the kernel kills this process at any system call except exit.
void forbid_system_calls() {
  std::array<sock_filter, 4> program{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
  }};
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  constexpr int kNotPossible = 77;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) _exit(kNotPossible);
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) _exit(kNotPossible);
}

// Status of a child that runs `work` without system calls; 0 if `work` returns true.
int status_of_child(const std::function<bool()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    forbid_system_calls();
    _exit(work() ? 0 : 1);
  }
  int status = -1;
  if (child < 0 || waitpid(child, &status, 0) != child) return -1;
  return status;
}

TEST(CyclePurity, NoSystemCall) {
  for (const Scene& scene : scenes()) {
    const auto session = std::make_unique<ScriptedLoop>(scene);
    const int status = status_of_child([&] {
      session->run();
      return session->did_everything();
    });
    EXPECT_FALSE(WIFSIGNALED(status)) << "killed by signal " << WTERMSIG(status);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
  }
}

TEST(CyclePurity, ASystemCallIsDeadly) {
  const int status = status_of_child([] { return syscall(SYS_getppid) > 0; });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGSYS);
}

}  // namespace
}  // namespace hapticwall::session

#endif  // HAPTICWALL_INTERPOSITION
