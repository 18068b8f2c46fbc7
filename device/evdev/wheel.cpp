#include "device/evdev/wheel.h"

#include <system_error>
#include <utility>

#include "device/os_threads.h"

namespace hapticwall::device {

Wheel::Wheel(WheelOptions options, WheelPort port, HostClock now_ns)
    : options_(std::move(options)), port_(std::move(port)), now_ns_(std::move(now_ns)) {}

Wheel::~Wheel() { Wheel::close(); }

std::shared_ptr<WheelKeeper> Wheel::keeper() const {
  const std::lock_guard lock(keeper_mutex_);
  return keeper_;
}

void Wheel::set_keeper(std::shared_ptr<WheelKeeper> keeper) {
  const std::lock_guard lock(keeper_mutex_);
  keeper_ = std::move(keeper);
}

DeviceInfo Wheel::info() const {
  const auto keeper = this->keeper();
  if (auto info = keeper ? keeper->info() : std::nullopt) return *std::move(info);
  DeviceInfo info;
  info.name = options_.name.empty() ? "wheel" : options_.name;
  return info;
}

Failure Wheel::open() {
  close();
  auto keeper = std::make_shared<WheelKeeper>(options_, port_, now_ns_);
  try {
    start_thread([keeper] { keeper->run(); }).detach();
  } catch (const std::system_error&) {
    return device_error("the device gets no thread: the system runs too many; end other programs");
  }
  set_keeper(keeper);
  Failure failure = keeper->wait_until_up();
  if (failure) close();
  return failure;
}

DeviceReading Wheel::read() {
  DeviceReading reading;
  reading.state = DeviceState::kFault;
  if (!keeper_) return reading;
  const AxesReading axes = keeper_->loop().read();
  reading.position_m = axes.position_m[0];
  reading.applied_force_n = keeper_->taken_n();
  reading.age_s = axes.age_s;
  reading.state = axes.state;
  return reading;
}

void Wheel::write(double force_n) {
  if (keeper_) keeper_->loop().write({force_n, 0.0});
}

void Wheel::enable(bool enabled) {
  if (keeper_) keeper_->loop().enable(enabled);
}

LinkStats Wheel::link() const { return keeper_ ? keeper_->loop().stats() : LinkStats{}; }

void Wheel::close() {
  if (!keeper_) return;
  keeper_->loop().enable(false);
  keeper_->loop().write({});
  keeper_->stop();
  set_keeper(nullptr);
}

std::string Wheel::trouble_details() const {
  const auto keeper = this->keeper();
  return keeper ? keeper->words() : std::string();
}

std::unique_ptr<Wheel> make_wheel(const WheelOptions& options) {
  return std::make_unique<Wheel>(options, WheelPort{}, monotonic_ns);
}

}  // namespace hapticwall::device
