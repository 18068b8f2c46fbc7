#include "tests/emulator/program/emulator_program.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/file/disk/atomic_file.h"
#include "app/session/loop/realtime_setup.h"
#include "core/result.h"
#include "hapticwall_version.h"
#include "tests/emulator/firmware/uhid_device.h"
#include "tests/emulator/program/device_loop.h"
#include "tests/emulator/program/emulator_options.h"
#include "tests/emulator/program/tick_log.h"

namespace hapticwall::emulator {
namespace {

using command::tell;

constexpr std::int64_t kNanosecondsInMicrosecond = 1000;
constexpr const char* kDescription =
    "Emulates a haptic device through /dev/uhid, by docs/hid-protocol.md, with the handle and the\n"
    "hand of SCENE. Serves to try a host without hardware; runs until Ctrl-C.";

// SCHED_FIFO priority: a device does not wait for the loop that drives it.
constexpr int kDevicePriority = 81;
static_assert(kDevicePriority > session::kLoopPriority);

// Requests priority and locked memory, which are optional. Returns the result in words.
std::string set_up_realtime() {
  session::use_default_floating_point();
  // The kernel joins pages into huge ones; a page fault meanwhile waits for milliseconds.
  prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
  sched_param parameters{};
  parameters.sched_priority = kDevicePriority;
  const bool fifo = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  const bool locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  return fmt::format(
      "{}, {}",
      fifo ? fmt::format("real-time priority {}", kDevicePriority) : "no real-time priority",
      locked ? "memory locked" : "memory not locked");
}

std::string footer() {
  return fmt::format(
      "Faults: {}\n\n"
      "Examples:\n"
      "  hapticwall-emulator press                            then: hapticwall devices\n"
      "  hapticwall-emulator press --fault unplugged@10+2     off the bus from second 10 to 12\n"
      "  hapticwall-emulator press --fault bad-crc@5+1/10     every tenth report of a second\n\n"
      "Exit status: 0 success (also Ctrl-C), 2 usage or scene error, 3 device, 4 a file could not "
      "be "
      "written",
      fault_names());
}

// Prints help or the version; anything else is an error.
Result<int> answer(const CLI::App& program, const CLI::ParseError& outcome) {
  std::optional<std::string> text;
  if (dynamic_cast<const CLI::CallForVersion*>(&outcome) != nullptr) {
    text = fmt::format("hapticwall-emulator {} ({})\n", kVersion, kBuild);
  } else if (outcome.get_exit_code() == 0) {
    text = program.help();
  }
  if (!text) return usage_error(outcome.what());
  return command::status_of(command::write_output(*text));
}

void tell_start(const Plan& plan, const std::string& realtime) {
  const Scene& scene = plan.device.axes.front();
  tell(fmt::format(
      "'{}', {} at {} Hz, is HID device {:04x}:{:04x}, serial {}, through /dev/uhid ({}); "
      "'hapticwall devices' lists it, Ctrl-C ends it",
      scene.name, plan.device.axes.size() == 2 ? "two axes" : "one axis", scene.sampling.rate_hz,
      plan.identity.vendor_id, plan.identity.product_id, plan.identity.serial, realtime));
}

void tell_end(const LoopStats& stats) {
  tell(fmt::format("{} ticks, {} commands; max latency of a tick {} us, {} reports not sent",
                   stats.ticks, stats.commands,
                   stats.largest_latency_ns / kNanosecondsInMicrosecond, stats.late_ticks));
}

// Opens the log before anything runs, so that an error shows at once.
Result<std::optional<file::AtomicFile>> open_log(const std::string& path) {
  if (path.empty()) return std::optional<file::AtomicFile>();
  Result<file::AtomicFile> file = file::AtomicFile::create(path);
  if (!file) return file.error();
  return std::optional(std::move(*file));
}

Failure write_log(const TickLog& log, file::AtomicFile& file) {
  if (Failure failed = file.write(log.text())) return failed;
  return file.commit();
}

Result<int> emulate(const Plan& plan) {
  Result<std::optional<file::AtomicFile>> log_file = open_log(plan.log);
  if (!log_file) return log_file.error();
  Result<std::unique_ptr<device::hid::VirtualBus>> bus = device::hid::open_uhid(plan.identity);
  if (!bus) return bus.error();
  device::hid::FirmwareEmulator device(plan.device, plan.faults);
  TickLog log;
  DeviceLoop loop(device, **bus, plan.loop);
  if (*log_file) loop.on_tick = [&] { log.take(row_of(device)); };
  loop.should_stop = [] { return command::stop_signal() != 0; };
  command::catch_stop_signals();
  tell_start(plan, set_up_realtime());
  const Failure failed = loop.run();
  if (*log_file) {
    if (Failure unwritten = write_log(log, **log_file)) return *unwritten;
  }
  if (failed) return *failed;
  tell_end(loop.stats());
  return 0;
}

Result<int> dispatch(int argc, const char* const* argv) {
  CLI::App program(kDescription, "hapticwall-emulator");
  program.set_version_flag("--version", std::string(kVersion), "Print the version and exit");
  EmulatorOptions options;
  add_options(program, options);
  program.footer(footer());
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& outcome) {
    return answer(program, outcome);
  }
  const Result<Plan> plan = make_plan(options);
  if (!plan) return plan.error();
  return emulate(*plan);
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  return command::run_guarded([&] { return dispatch(argc, argv); });
}

}  // namespace hapticwall::emulator
