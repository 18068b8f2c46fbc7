#include "tests/emulator/program/emulator_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/file/scene/scene_file.h"
#include "app/file/text/text.h"
#include "core/units.h"

namespace hapticwall::emulator {
namespace {

using device::hid::Fault;
using device::hid::FaultKind;

constexpr double kMaxTimeS = 86400.0;
constexpr std::uint32_t kMaxTicksApart = 1'000'000;
constexpr double kMaxAmount = 1e6;

struct NamedKind {
  std::string_view name;
  FaultKind kind;
};

constexpr auto kKinds = std::to_array<NamedKind>({
    {"empty", FaultKind::kEmpty},
    {"short", FaultKind::kShort},
    {"over-long", FaultKind::kOverLong},
    {"wrong-id", FaultKind::kWrongId},
    {"wrong-major", FaultKind::kWrongMajor},
    {"bad-crc", FaultKind::kBadCrc},
    {"all-zero", FaultKind::kAllZero},
    {"skipped", FaultKind::kSkipped},
    {"repeated", FaultKind::kRepeated},
    {"silent", FaultKind::kSilent},
    {"not-polled", FaultKind::kNotPolled},
    {"no-output", FaultKind::kNoOutput},
    {"unplugged", FaultKind::kUnplugged},
    {"frozen", FaultKind::kFrozen},
    {"restart", FaultKind::kRestart},
    {"emergency-stop", FaultKind::kEmergencyStop},
    {"over-temperature", FaultKind::kOverTemperature},
    {"over-current", FaultKind::kOverCurrent},
    {"encoder-fault", FaultKind::kEncoderFault},
    {"jump", FaultKind::kJump},
    {"runaway", FaultKind::kRunaway},
    {"slow", FaultKind::kSlow},
    {"rejects", FaultKind::kRejects},
    {"no-answer", FaultKind::kNoAnswer},
    {"withheld-answer", FaultKind::kWithheldAnswer},
    {"not-enabled", FaultKind::kNotEnabled},
    {"no-force", FaultKind::kNoForce},
    {"other-force", FaultKind::kOtherForce},
    {"foreign-force", FaultKind::kForeignForce},
    {"wrong-sign", FaultKind::kWrongSign},
    {"no-push", FaultKind::kNoPush},
    {"clock-rate", FaultKind::kClockRate},
    {"clock-jump", FaultKind::kClockJump},
    {"noise", FaultKind::kNoise},
});
static_assert(kKinds.size() == device::hid::kFaultKinds);

std::optional<std::uint64_t> microseconds_of(std::string_view text) {
  const std::optional<double> seconds = file::parsed<double>(text);
  if (!seconds || !(*seconds >= 0.0 && *seconds <= kMaxTimeS)) return std::nullopt;
  return static_cast<std::uint64_t>(std::llround(*seconds * kMicrosecondsPerSecond));
}

Error refusal(std::string_view text, std::string_view why) {
  return usage_error(fmt::format("--fault {}: {}", file::in_quotes(text), why));
}

constexpr int kHexadecimal = 16;

// Tick of a scene in whole microseconds; 0 if it is not whole.
std::uint64_t tick_us_of(const Scene& scene) {
  const double tick_us = kMicrosecondsPerSecond / scene.sampling.rate_hz;
  const double whole_us = std::round(tick_us);
  constexpr double kRounding = 1e-9;  // relative, of a rate like 3125 Hz
  if (whole_us < 1.0 || whole_us > device::hid::kMaxTickUs) return 0;
  return std::abs(tick_us - whole_us) <= kRounding * tick_us ? static_cast<std::uint64_t>(whole_us)
                                                             : 0;
}

Result<Scene> load_axis(const std::string& name, const std::vector<std::string>& settings) {
  Result<file::LoadedScene> loaded = file::load_scene(name, settings);
  if (!loaded) return loaded.error();
  const std::string shown = file::shown(name);
  if (!loaded->changes.empty() || loaded->first_recorded_tick != 0) {
    return usage_error(shown +
                       ": a part of a session, or one in which parameters changed; choose a scene "
                       "without changes");
  }
  if (loaded->scene.x().hand && loaded->scene.x().hand->follows_mouse) {
    return usage_error(shown +
                       ": hand.path: the emulator has no mouse to follow; --set "
                       "'hand.path=[[0, 0.03], [1, 0.06]]' gives it a path");
  }
  if (tick_us_of(loaded->scene) == 0) {
    return usage_error(fmt::format(
        "{}: sampling.rate_hz: {} Hz; the tick of a device is a whole "
        "number of microseconds, 1 to {}",
        shown, file::shortest_number(loaded->scene.sampling.rate_hz), device::hid::kMaxTickUs));
  }
  return std::move(loaded->scene);
}

Failure load_scenes(const EmulatorOptions& options, Plan& plan) {
  std::vector<Scene>& axes = plan.device.axes;
  axes.clear();
  for (const std::string& name : options.scenes) {
    if (name.empty() && !axes.empty()) break;  // without --y
    Result<Scene> scene =
        load_axis(name, axes.empty() ? options.settings : std::vector<std::string>());
    if (!scene) return scene.error();
    if (!axes.empty() && scene->sampling.rate_hz != axes.front().sampling.rate_hz) {
      return usage_error(
          fmt::format("--y {}: its sampling.rate_hz differs from that of the first "
                      "scene; both axes share one tick",
                      file::in_quotes(name)));
    }
    axes.push_back(std::move(*scene));
  }
  return {};
}

std::optional<std::uint16_t> parse_id(std::string_view text) {
  if (text.substr(0, 2) == "0x" || text.substr(0, 2) == "0X") text.remove_prefix(2);
  return file::parsed<std::uint16_t>(text, kHexadecimal);
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
       {std::tuple{"--serial", &options.serial, device::hid::kMaxUhidSerialBytes},
        std::tuple{"--name", &options.name, device::hid::kMaxUhidNameBytes}}) {
    if (text->empty() || text->size() > longest) {
      return usage_error(
          fmt::format("{} {}: it takes 1 to {} bytes", option, file::in_quotes(*text), longest));
    }
  }
  identity.serial = options.serial;
  identity.name = options.name;
  return {};
}

Failure take_numbers(const EmulatorOptions& options, Plan& plan) {
  if (!options.duration.empty()) {
    const std::optional<double> seconds = file::parsed<double>(options.duration);
    if (!seconds || !(*seconds > 0.0 && *seconds <= kMaxTimeS)) {
      return usage_error(fmt::format("--duration {}: it takes seconds, more than 0 and at most {}",
                                     file::in_quotes(options.duration), kMaxTimeS));
    }
    plan.loop.duration_us =
        static_cast<std::uint64_t>(std::ceil(*seconds * kMicrosecondsPerSecond));
  }
  if (!options.watchdog_ms.empty()) {
    const auto watchdog = file::parsed<std::uint16_t>(options.watchdog_ms);
    if (!watchdog || *watchdog == 0 || *watchdog > device::hid::kMaxTimeToLiveMs) {
      return usage_error(fmt::format("--watchdog {}: it takes whole milliseconds, 1 to {}",
                                     file::in_quotes(options.watchdog_ms),
                                     device::hid::kMaxTimeToLiveMs));
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
      .add_option("SCENE", options.scenes[0],
                  "Handle and hand: a scene file, or the name of a built-in scene")
      ->type_name("")
      ->capture_default_str();
  program.add_option("--y", options.scenes[1], "Handle and hand of a second axis")
      ->type_name("SCENE");
  program
      .add_option("--set", options.settings, "A key of SCENE, e.g. hand.mass_kg=0.3 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_identity(CLI::App& program, EmulatorOptions& options) {
  const auto add = [&](const char* name, std::string& value, const char* what, const char* type) {
    program.add_option(name, value, what)->type_name(type)->capture_default_str();
  };
  add("--vendor", options.vendor, "Vendor id, hexadecimal", "ID");
  add("--product", options.product, "Product id, hexadecimal", "ID");
  add("--serial", options.serial, "Serial number", "TEXT");
  add("--name", options.name, "Name of the device", "TEXT");
}

}  // namespace

std::string fault_names() { return file::joined(file::names_of(kKinds, &NamedKind::name)); }

Result<Fault> parse_fault(std::string_view text) {
  const std::size_t at = text.find('@');
  const std::size_t plus = text.find('+', at == std::string_view::npos ? text.size() : at);
  if (plus == std::string_view::npos) {
    return refusal(text, "it takes KIND@BEGIN+DURATION in seconds, e.g. unplugged@3+1");
  }
  const std::size_t equals = text.substr(0, at).find('=');
  const std::string_view name = text.substr(0, std::min(at, equals));
  const auto* known = std::find_if(kKinds.begin(), kKinds.end(),
                                   [&](const NamedKind& one) { return one.name == name; });
  if (known == kKinds.end()) {
    const std::string hint = file::suggestion(name, file::names_of(kKinds, &NamedKind::name));
    return refusal(text, fmt::format("unknown fault{}; known: {}", hint, fault_names()));
  }
  const std::size_t slash = text.find('/', plus);
  const auto begin = microseconds_of(text.substr(at + 1, plus - at - 1));
  const auto duration = microseconds_of(text.substr(plus + 1, slash - plus - 1));
  if (!begin || !duration) {
    return refusal(text, fmt::format("BEGIN and DURATION take seconds, 0 to {}", kMaxTimeS));
  }
  std::optional<std::uint32_t> every = 1;
  if (slash != std::string_view::npos) every = file::parsed<std::uint32_t>(text.substr(slash + 1));
  if (!every || *every == 0 || *every > kMaxTicksApart) {
    return refusal(text, fmt::format("/EVERY takes a number of ticks, 1 to {}", kMaxTicksApart));
  }
  std::optional<double> amount;
  if (equals != std::string_view::npos) {
    amount = file::parsed<double>(text.substr(equals + 1, at - equals - 1));
    if (!amount || !(std::abs(*amount) <= kMaxAmount) ||
        device::hid::usual_amount(known->kind) == 0.0) {
      return refusal(text, "=AMOUNT takes a number, and only a lie that has one");
    }
  }
  return Fault{known->kind, *begin, *duration, *every, amount};
}

void add_options(CLI::App& program, EmulatorOptions& options) {
  add_scenes(program, options);
  add_identity(program, options);
  program
      .add_option(
          "--fault", options.faults,
          "KIND[=AMOUNT]@BEGIN+DURATION in seconds since the start; =AMOUNT: of a lie (jump m, "
          "runaway m/s, slow s, withheld-answer commands, other-force factor, "
          "foreign-force N, clock-rate factor, clock-jump s, noise m); /EVERY: only every N-th "
          "tick (repeatable)")
      ->type_name("FAULT")
      ->allow_extra_args(false);
  program
      .add_option("--hand", options.hand,
                  "waits: the hand starts when the host first enables the device; goes: at once")
      ->type_name("WORD")
      ->capture_default_str();
  program.add_flag(
      "--in-step", options.in_step,
      "Shift the tick once, so that the host's commands arrive half-way between two ticks");
  program.add_option("--watchdog", options.watchdog_ms, "Milliseconds, instead of 50")
      ->type_name("MS");
  program.add_flag("--no-info", options.without_info,
                   "Send no INFO report: a device file must describe the device");
  program.add_option("--duration", options.duration, "End after this time, seconds")
      ->type_name("S");
  program.add_option("--log", options.log, "Write every tick of the device as CSV, at the end")
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
