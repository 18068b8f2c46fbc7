#include "app/emulator/emulator_program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "app/command/signals.h"
#include "app/command/terminal.h"
#include "app/emulator/device_loop.h"
#include "app/emulator/emulator_options.h"
#include "app/emulator/fault_text.h"
#include "app/emulator/realtime.h"
#include "app/emulator/tick_log.h"
#include "app/file/atomic_file.h"
#include "device/emulator/uhid_device.h"
#include "hapticwall_version.h"

namespace hapticwall::emulator {
namespace {

using command::report;
using command::tell;

constexpr std::int64_t kNanosecondsInMicrosecond = 1000;
constexpr const char* kDescription =
    "A haptic device that is not there: makes a HID device through /dev/uhid that behaves as\n"
    "docs/hid-protocol.md asks, with the handle and the hand of SCENE behind it. For trying a "
    "host\n"
    "without hardware; runs until Ctrl-C.";

std::string footer() {
  return fmt::format(
      "Faults: {}\n\n"
      "Examples:\n"
      "  hapticwall-emulator press                            then: hapticwall devices\n"
      "  hapticwall-emulator press --fault unplugged@10+2     off the bus from second 10 to 12\n"
      "  hapticwall-emulator press --fault bad-crc@5+1/10     every tenth report of a second\n\n"
      "Exit status: 0 fine (Ctrl-C too), 2 usage or scene error, 3 device, 4 a file could not be "
      "written",
      fault_names());
}

// Help and version are answers, everything else one line.
int answer(const CLI::App& program, const CLI::ParseError& outcome) {
  std::optional<std::string> text;
  if (dynamic_cast<const CLI::CallForVersion*>(&outcome) != nullptr) {
    text = fmt::format("hapticwall-emulator {} ({})\n", kVersion, kBuild);
  } else if (outcome.get_exit_code() == 0) {
    text = program.help();
  }
  if (!text) return report({ErrorKind::kUsage, outcome.what()});
  const Failure failed = command::write_output(*text);
  return failed ? report(*failed) : 0;
}

void tell_start(const Plan& plan, const std::string& realtime) {
  tell(fmt::format(
      "'{}', {} at {} Hz, is HID device {:04x}:{:04x}, serial {}, through /dev/uhid ({}); "
      "'hapticwall devices' finds it, Ctrl-C ends it",
      plan.device.x.name, plan.device.y ? "two axes" : "one axis", plan.device.x.sampling.rate_hz,
      plan.identity.vendor_id, plan.identity.product_id, plan.identity.serial, realtime));
}

void tell_end(const LoopFigures& figures) {
  tell(fmt::format("{} ticks, {} commands; largest latency of a tick {} us, {} reports not sent",
                   figures.ticks, figures.commands,
                   figures.largest_latency_ns / kNanosecondsInMicrosecond, figures.late_ticks));
}

// The log's file is made before anything runs: whether it can be is not found out at the end.
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

int emulate(const Plan& plan) {
  Result<std::optional<file::AtomicFile>> log_file = open_log(plan.log);
  if (!log_file) return report(log_file.error());
  Result<std::unique_ptr<device::hid::VirtualBus>> bus = device::hid::open_uhid(plan.identity);
  if (!bus) return report(bus.error());
  device::hid::FirmwareEmulator device(plan.device, plan.faults);
  TickLog log;
  DeviceLoop loop(device, **bus, plan.loop);
  if (*log_file) loop.on_tick = [&] { log.take(row_of(device)); };
  loop.should_stop = [] { return command::stop_signal() != 0; };
  command::catch_stop_signals();
  tell_start(plan, set_up_realtime());
  const Failure failed = loop.run();
  if (*log_file) {
    if (const Failure unwritten = write_log(log, **log_file)) return report(*unwritten);
  }
  if (failed) return report(*failed);
  tell_end(loop.figures());
  return 0;
}

int dispatch(int argc, const char* const* argv) {
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
  return plan ? emulate(*plan) : report(plan.error());
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  command::ignore_write_signals();
  try {
    return dispatch(argc, argv);
  } catch (const std::bad_alloc&) {
    return report({ErrorKind::kUsage, "this needs more memory than there is"});
  } catch (const std::exception& error) {
    return report({ErrorKind::kUsage, fmt::format("internal error: {}", error.what())});
  }
}

}  // namespace hapticwall::emulator
