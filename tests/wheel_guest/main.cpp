// hapticwall-wheel: an emulated force-feedback wheel on the virtual USB bus, for the guest.
//
//   hapticwall-wheel log=FILE [scene=NAME] [rate=HZ] [interval=MS] [takes=HZ] [full=N]
//                    [autocentre=1] [held=0] [deaf=S] [stall=S] [unplug=S] [stop=S]
//                    [set=KEY=VALUE ...]
//   hapticwall-wheel push=/dev/input/event0 [level=LEVEL]   another program's force, for a second
//   hapticwall-wheel axis=/dev/input/event0                 prints fuzz and flat
//   hapticwall-wheel signal=NUMBER pid=PROCESS              sends it, prints the time in us
//
// The wheel sends positions at rate=, and takes reports at takes=: all that the endpoint's interval
// permits if it is not given. Until the first effect it trembles by a count; held=0: it does not,
// and the kernel hears nothing of it. stall= takes none for 400 ms. Times count from the first tick
// of the hand. The log has one row a millisecond, with the clock that all programs of the machine
// share.
#include <fcntl.h>
#include <linux/input.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "device/os_threads.h"
#include "tests/wheel_guest/descriptors.h"
#include "tests/wheel_guest/firmware.h"
#include "tests/wheel_guest/usbip.h"

namespace hapticwall::wheel {
namespace {

constexpr std::int64_t kTickNs = 1'000'000;
constexpr int kPriority = 90;  // above the loop: hardware does not wait for a program
volatile std::sig_atomic_t stopped = 0;

struct Arguments {
  std::map<std::string, std::string> values;
  std::vector<std::string> settings;

  Arguments(int count, char** texts) {
    for (int i = 1; i < count; ++i) {
      const std::string text = texts[i];
      const std::size_t equals = text.find('=');
      const std::string key = text.substr(0, equals);
      if (key == "set") settings.push_back(text.substr(equals + 1));
      values[key] = equals == std::string::npos ? "" : text.substr(equals + 1);
    }
  }
  [[nodiscard]] double number(const std::string& key, double otherwise) const {
    const auto found = values.find(key);
    return found == values.end() ? otherwise : std::stod(found->second);
  }
  [[nodiscard]] std::string text(const std::string& key, const std::string& otherwise) const {
    const auto found = values.find(key);
    return found == values.end() ? otherwise : found->second;
  }
};

class Wheel {
 public:
  Wheel(const Arguments& arguments, const Scene& scene, std::FILE* log)
      : firmware_(scene, settings_of(arguments)),
        interval_(static_cast<unsigned>(arguments.number("interval", 1))),
        takes_per_tick_(arguments.number("takes", 1e3 / interval_) / 1e3),
        stall_s_(arguments.number("stall", 1e9)),
        unplug_s_(arguments.number("unplug", 1e9)),
        stop_s_(arguments.number("stop", 1e9)),
        log_(log) {
    std::fputs("time_us,position_m,force_n,level,taken\n", log_);
  }

  int run() {
    if (!bus_.there()) return 1;
    hurry_bus(kPriority);
    std::int64_t next_ns = device::monotonic_ns();
    while (stopped == 0 && hand_ms_ < 1e3 * stop_s_) {
      next_ns += kTickNs;
      const timespec until{next_ns / 1'000'000'000, next_ns % 1'000'000'000};
      ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
      tick();
    }
    return 0;
  }

 private:
  static Settings settings_of(const Arguments& arguments) {
    Settings settings;
    settings.full_force_n = arguments.number("full", settings.full_force_n);
    settings.report_hz = arguments.number("rate", settings.report_hz);
    settings.autocentres = arguments.number("autocentre", 0.0) != 0.0;
    settings.is_held = arguments.number("held", 1.0) != 0.0;
    settings.deaf_after_s = arguments.number("deaf", settings.deaf_after_s);
    return settings;
  }

  void tick() {
    bus_.take_all([this](const Transfer& transfer) { return answer(transfer); });
    take_output();
    if (++ticks_ % interval_ == 0) {
      if (!pending_) pending_ = firmware_.news();
      if (pending_ && bus_.send(*pending_)) pending_.reset();
    }
    firmware_.tick();
    if (firmware_.started()) ++hand_ms_;
    if (hand_ms_ >= 1e3 * unplug_s_) bus_.unplug();
    std::fprintf(log_, "%lld,%.7f,%.4f,%d,%u\n",
                 static_cast<long long>(device::monotonic_ns() / 1000), firmware_.position_m(),
                 firmware_.force_n(), firmware_.level(), firmware_.taken());
  }

  void take_output() {
    constexpr double kStallMs = 400.0;
    may_take_ = std::min(may_take_ + takes_per_tick_, 0.999 + takes_per_tick_);
    const bool stalls = hand_ms_ >= 1e3 * stall_s_ && hand_ms_ < 1e3 * stall_s_ + kStallMs;
    if (may_take_ < 1.0 || stalls) return;
    may_take_ -= 1.0;
    if (const auto report = bus_.receive()) firmware_.take(*report);
  }

  using Answer = std::optional<std::vector<std::uint8_t>>;
  [[nodiscard]] Answer answer(const Transfer& transfer) {
    const std::uint8_t kind = transfer.setup[0];
    const std::uint8_t request = transfer.setup[1];
    if (request == 6 && transfer.in) return descriptor(transfer.setup[3], transfer.setup[2]);
    if (kind == 0xA1 && request == 1) {  // GET_REPORT
      auto report = firmware_.feature(transfer.setup[2]);
      return report.empty() ? Answer() : Answer(report);
    }
    if (kind == 0x21 && request == 9) firmware_.take(transfer.bytes);    // SET_REPORT
    if (transfer.in) return std::vector<std::uint8_t>(transfer.length);  // status
    return std::vector<std::uint8_t>();  // configuration, interface, idle
  }

  [[nodiscard]] Answer descriptor(std::uint8_t kind, std::uint8_t index) const {
    const auto bytes = [](const auto& all) {
      return std::vector<std::uint8_t>(all.begin(), all.end());
    };
    if (kind == 1) return bytes(kDeviceDescriptor);
    if (kind == 2) return bytes(configuration(static_cast<std::uint8_t>(interval_)));
    if (kind == 0x22) return bytes(kReportDescriptor);
    if (kind != 3) return std::nullopt;
    if (index == 0) return std::vector<std::uint8_t>{4, 3, 0x09, 0x04};
    const std::string name = index == 1 ? "Haptic Wall" : "test wheel";
    std::vector<std::uint8_t> text{static_cast<std::uint8_t>(2 + 2 * name.size()), 3};
    for (const char letter : name) {
      text.push_back(static_cast<std::uint8_t>(letter));
      text.push_back(0);
    }
    return text;
  }

  Firmware firmware_;
  UsbBus bus_;
  unsigned interval_;
  double takes_per_tick_;
  double may_take_ = 0.0;
  double stall_s_;
  double unplug_s_;
  double stop_s_;
  std::FILE* log_;
  std::uint64_t ticks_ = 0;
  double hand_ms_ = 0.0;
  std::optional<std::array<std::uint8_t, 3>> pending_;
};

// Another program's constant force, as a game would make it.
int push(const std::string& node, double level) {
  const int descriptor = ::open(node.c_str(), O_RDWR | O_CLOEXEC);
  ff_effect effect{};
  effect.type = FF_CONSTANT;
  effect.id = -1;
  effect.direction = 0x4000;
  effect.replay.length = 500;
  effect.u.constant.level = static_cast<std::int16_t>(level);
  if (::ioctl(descriptor, EVIOCSFF, &effect) < 0) return 1;
  input_event play{};
  play.type = EV_FF;
  play.code = static_cast<std::uint16_t>(effect.id);
  play.value = 1;
  const bool done = ::write(descriptor, &play, sizeof play) > 0;
  ::sleep(1);
  ::close(descriptor);
  return done ? 0 : 1;
}

int print_axis(const std::string& node) {
  const int descriptor = ::open(node.c_str(), O_RDONLY | O_CLOEXEC);
  input_absinfo axis{};
  if (::ioctl(descriptor, EVIOCGABS(ABS_X), &axis) < 0) return 1;
  ::close(descriptor);
  std::printf("%d %d\n", axis.fuzz, axis.flat);
  return 0;
}

int send_signal(const Arguments& arguments) {
  const auto process = static_cast<pid_t>(arguments.number("pid", 0.0));
  const std::int64_t now_ns = device::monotonic_ns();
  if (process <= 0 || ::kill(process, static_cast<int>(arguments.number("signal", 0.0))) != 0)
    return 1;
  std::printf("%lld\n", static_cast<long long>(now_ns / 1000));
  return 0;
}

int run(const Arguments& arguments) {
  if (arguments.values.count("axis") != 0) return print_axis(arguments.text("axis", ""));
  if (arguments.values.count("signal") != 0) return send_signal(arguments);
  if (arguments.values.count("push") != 0) {
    return push(arguments.text("push", ""), arguments.number("level", 3000));
  }
  const auto scene = file::load_scene(arguments.text("scene", "press"), arguments.settings);
  if (!scene) {
    std::fprintf(stderr, "%s\n", scene.error().message.c_str());
    return 2;
  }
  std::signal(SIGTERM, [](int) { stopped = 1; });
  const sched_param priority{kPriority};
  ::sched_setscheduler(0, SCHED_FIFO, &priority);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> log(
      std::fopen(arguments.text("log", "/dev/null").c_str(), "w"), &std::fclose);
  return log ? Wheel(arguments, scene->scene, log.get()).run() : 2;
}

}  // namespace
}  // namespace hapticwall::wheel

int main(int count, char** texts) {
  return hapticwall::wheel::run(hapticwall::wheel::Arguments(count, texts));
}
