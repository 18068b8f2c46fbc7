#include "app/emulator/emulator_options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "app/emulator/fault_text.h"
#include "app/file/scene_file.h"
#include "app/file/text.h"
#include "core/units.h"
#include "core/usage_error.h"

namespace hapticwall::emulator {
namespace {

constexpr double kLongestRunS = 86400.0;
constexpr int kHexadecimal = 16;
constexpr std::uint16_t kLongestTickUs = std::numeric_limits<std::uint16_t>::max();

// Tick of a scene, whole microseconds; 0 where it is none.
std::uint64_t tick_us_of(const Scene& scene) {
  const double tick_us = kMicrosecondsPerSecond / scene.sampling.rate_hz;
  const double whole_us = std::round(tick_us);
  constexpr double kRounding = 1e-9;  // relative, of a rate like 3125 Hz
  if (whole_us < 1.0 || whole_us > kLongestTickUs) return 0;
  return std::abs(tick_us - whole_us) <= kRounding * tick_us ? static_cast<std::uint64_t>(whole_us)
                                                             : 0;
}

Result<Scene> load_axis(const std::string& name, const std::vector<std::string>& settings) {
  Result<file::LoadedScene> loaded = file::load_scene(name, settings);
  if (!loaded) return loaded.error();
  const std::string shown = file::shown(name);
  if (!loaded->changes.empty() || loaded->first_recorded_tick != 0) {
    return usage_error(shown +
                       ": a part of a session, or one in which parameters changed; a device takes "
                       "a plain scene");
  }
  if (loaded->scene.hand && loaded->scene.hand->follows_mouse) {
    return usage_error(shown +
                       ": hand.path: there is no mouse here to follow; --set "
                       "'hand.path=[[0, 0.03], [1, 0.06]]' gives it a path");
  }
  if (tick_us_of(loaded->scene) == 0) {
    return usage_error(
        fmt::format("{}: sampling.rate_hz: {} Hz; the tick of a device is a whole "
                    "number of microseconds, 1 to {}",
                    shown, file::number_text(loaded->scene.sampling.rate_hz), kLongestTickUs));
  }
  return std::move(loaded->scene);
}

Failure load_scenes(const EmulatorOptions& options, Plan& plan) {
  Result<Scene> x = load_axis(options.scene, options.settings);
  if (!x) return x.error();
  plan.device.x = std::move(*x);
  if (options.y_scene.empty()) return {};
  Result<Scene> y = load_axis(options.y_scene, {});
  if (!y) return y.error();
  if (y->sampling.rate_hz != plan.device.x.sampling.rate_hz) {
    return usage_error(
        fmt::format("--y {}: both axes have one tick, and their scenes differ in "
                    "sampling.rate_hz",
                    file::in_quotes(options.y_scene)));
  }
  plan.device.y = std::move(*y);
  return {};
}

std::optional<std::uint16_t> parse_id(std::string_view text) {
  if (text.substr(0, 2) == "0x" || text.substr(0, 2) == "0X") text.remove_prefix(2);
  std::uint16_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value, kHexadecimal);
  if (code != std::errc{} || rest != end) return std::nullopt;
  return value;
}

Failure identify(const EmulatorOptions& options, device::hid::HidIdentity& identity) {
  for (const auto& [option, text, id] :
       {std::tuple{"--vendor", &options.vendor, &identity.vendor_id},
        std::tuple{"--product", &options.product, &identity.product_id}}) {
    const std::optional<std::uint16_t> value = parse_id(*text);
    if (!value) {
      return usage_error(fmt::format("{} {}: it takes a hexadecimal number, 0 to ffff", option,
                                     file::in_quotes(*text)));
    }
    *id = *value;
  }
  for (const auto& [option, text, longest] :
       {std::tuple{"--serial", &options.serial, device::hid::kLongestUhidSerial},
        std::tuple{"--name", &options.name, device::hid::kLongestUhidName}}) {
    if (text->empty() || text->size() > longest) {
      return usage_error(
          fmt::format("{} {}: it takes 1 to {} bytes", option, file::in_quotes(*text), longest));
    }
  }
  identity.serial = options.serial;
  identity.name = options.name;
  return {};
}

template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc{} || rest != end) return std::nullopt;
  return value;
}

Failure take_numbers(const EmulatorOptions& options, Plan& plan) {
  if (!options.duration.empty()) {
    const std::optional<double> seconds = number_of<double>(options.duration);
    if (!seconds || !(*seconds > 0.0 && *seconds <= kLongestRunS)) {
      return usage_error(fmt::format("--duration {}: it takes seconds, more than 0 and at most {}",
                                     file::in_quotes(options.duration), kLongestRunS));
    }
    plan.loop.duration_us =
        static_cast<std::uint64_t>(std::ceil(*seconds * kMicrosecondsPerSecond));
  }
  if (!options.watchdog_ms.empty()) {
    const auto watchdog = number_of<std::uint16_t>(options.watchdog_ms);
    if (!watchdog || *watchdog == 0 || *watchdog > device::hid::kLongestTimeToLiveMs) {
      return usage_error(fmt::format("--watchdog {}: it takes whole milliseconds, 1 to {}",
                                     file::in_quotes(options.watchdog_ms),
                                     device::hid::kLongestTimeToLiveMs));
    }
    plan.device.watchdog_ms = *watchdog;
  }
  if (options.hand != "waits" && options.hand != "goes") {
    return usage_error(
        fmt::format("--hand {}: it takes 'waits' or 'goes'", file::in_quotes(options.hand)));
  }
  plan.device.hand_waits = options.hand == "waits";
  return {};
}

Failure take_faults(const EmulatorOptions& options, Plan& plan) {
  std::vector<device::hid::Fault> faults;
  for (const std::string& text : options.faults) {
    Result<device::hid::Fault> fault = parse_fault(text);
    if (!fault) return fault.error();
    faults.push_back(*fault);
  }
  plan.faults = device::hid::FaultScript(std::move(faults));
  return {};
}

void add_scenes(CLI::App& program, EmulatorOptions& options) {
  program
      .add_option("SCENE", options.scene,
                  "Handle and hand: a scene file or the name of a built-in scene")
      ->type_name("")
      ->capture_default_str();
  program.add_option("--y", options.y_scene, "Handle and hand of a second axis")
      ->type_name("SCENE");
  program
      .add_option("--set", options.settings, "A key of SCENE, e.g. hand.mass_kg=0.3 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_identity(CLI::App& program, EmulatorOptions& options) {
  program.add_option("--vendor", options.vendor, "Vendor id, hexadecimal")
      ->type_name("ID")
      ->capture_default_str();
  program.add_option("--product", options.product, "Product id, hexadecimal")
      ->type_name("ID")
      ->capture_default_str();
  program.add_option("--serial", options.serial, "Serial number")
      ->type_name("TEXT")
      ->capture_default_str();
  program.add_option("--name", options.name, "What the device calls itself")
      ->type_name("TEXT")
      ->capture_default_str();
}

}  // namespace

void add_options(CLI::App& program, EmulatorOptions& options) {
  add_scenes(program, options);
  add_identity(program, options);
  program
      .add_option("--fault", options.faults,
                  "KIND@BEGIN+DURATION, seconds since the start; /EVERY behind it for every so "
                  "many ticks (repeatable)")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  program
      .add_option("--hand", options.hand,
                  "waits: at its start, until the host enables the device for the first time; "
                  "goes: at once")
      ->type_name("WORD")
      ->capture_default_str();
  program.add_flag("--in-step", options.in_step,
                   "Move the tick once, to where the host's commands lie half-way between two");
  program.add_option("--watchdog", options.watchdog_ms, "Milliseconds, instead of 50")
      ->type_name("MS");
  program.add_flag("--no-info", options.without_info,
                   "Without the INFO report: a device that a file must describe");
  program.add_option("--duration", options.duration, "End after so many seconds")->type_name("S");
  program.add_option("--log", options.log, "At the end, every tick of the device as CSV")
      ->type_name("FILE");
}

Result<Plan> make_plan(const EmulatorOptions& options) {
  Plan plan;
  plan.loop.in_step = options.in_step;
  plan.device.has_info = !options.without_info;
  plan.log = options.log;
  if (const Failure failed = take_faults(options, plan)) return *failed;
  if (const Failure failed = identify(options, plan.identity)) return *failed;
  if (const Failure failed = take_numbers(options, plan)) return *failed;
  if (const Failure failed = load_scenes(options, plan)) return *failed;
  return plan;
}

}  // namespace hapticwall::emulator
