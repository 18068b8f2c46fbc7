#include "device/port/impulse_engine.h"

#include <utility>

#include "device/link/link_machine.h"
#include "device/os_threads.h"
#include "device/port/dialect_port.h"

namespace hapticwall::device {

ImpulseEngine::ImpulseEngine(ImpulseEngineOptions options, hid::PortOpener open_port,
                             HostClock now_ns)
    : options_(std::move(options)),
      open_port_(hid::translated(options_, std::move(open_port), now_ns)),
      now_ns_(std::move(now_ns)) {}

ImpulseEngine::~ImpulseEngine() { ImpulseEngine::close(); }

std::shared_ptr<LinkMachine> ImpulseEngine::machine() const {
  const std::lock_guard lock(machine_mutex_);
  return machine_;
}

void ImpulseEngine::set_machine(std::shared_ptr<LinkMachine> machine) {
  const std::lock_guard lock(machine_mutex_);
  machine_ = std::move(machine);
}

DeviceInfo ImpulseEngine::info() const {
  DeviceInfo info;
  info.name = options_.name.empty() ? options_.kind : options_.name;
  info.delay_date = options_.delay_date;
  const auto machine = this->machine();
  const auto description = machine ? machine->owner().description() : std::nullopt;
  if (!description) return info;
  info.name = description->name;
  info.encoder_m = description->axis[0].encoder_m;
  info.force_limit_n = description->axis[0].force_limit_n;
  info.motion = description->axis[0].motion;
  info.max_force_rate_n_per_s = description->axis[0].max_force_rate_n_per_s;
  return info;
}

Failure ImpulseEngine::open() {
  close();
  set_machine(std::make_shared<LinkMachine>(options_, open_port_, now_ns_));
  Failure failure = machine_->bring_up();
  if (failure) close();
  return failure;
}

DeviceReading ImpulseEngine::read() {
  const AxesReading axes = read_axes();
  DeviceReading reading;
  reading.position_m = axes.position_m[0];
  reading.age_s = axes.age_s;
  reading.device_time_s = axes.device_time_s;
  reading.state = axes.state;
  reading.applied_force_n = axes.applied_n[0];
  return reading;
}

void ImpulseEngine::write(double force_n) { write_axes({force_n, 0.0}); }

AxesReading ImpulseEngine::read_axes() {
  return machine_ ? machine_->loop().read() : AxesReading{};
}

void ImpulseEngine::write_axes(const AxisValues& force_n) {
  if (machine_) machine_->loop().write(force_n);
}

void ImpulseEngine::enable(bool enabled) {
  if (machine_) machine_->loop().enable(enabled);
}

LinkStats ImpulseEngine::link() const { return machine_ ? machine_->loop().stats() : LinkStats{}; }

void ImpulseEngine::close() {
  if (!machine_) return;
  machine_->loop().enable(false);
  machine_->loop().write({});
  machine_->take_down();
  set_machine(nullptr);
}

std::string ImpulseEngine::trouble_details() const {
  const auto machine = this->machine();
  return machine ? machine->owner().words() : std::string();
}

std::unique_ptr<ImpulseEngine> make_impulse_engine(const ImpulseEngineOptions& options) {
  const auto open_port = []() -> Result<std::shared_ptr<hid::Port>> {
    auto port = hid::open_system_port();
    if (!port) return port.error();
    return std::shared_ptr<hid::Port>(std::move(*port));
  };
  return std::make_unique<ImpulseEngine>(options, open_port, monotonic_ns);
}

std::unique_ptr<ImpulseEngine> make_impulse_engine(const ImpulseEngineOptions& options,
                                                   std::unique_ptr<hid::Port> port,
                                                   HostClock now_ns) {
  const std::shared_ptr<hid::Port> shared = std::move(port);
  const auto open_port = [shared]() -> Result<std::shared_ptr<hid::Port>> { return shared; };
  return std::make_unique<ImpulseEngine>(options, open_port, std::move(now_ns));
}

}  // namespace hapticwall::device
