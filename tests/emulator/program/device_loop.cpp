#include "tests/emulator/program/device_loop.h"

#include <algorithm>

namespace hapticwall::emulator {
namespace {

using device::hid::BusRequest;
using device::hid::RequestKind;

constexpr std::int64_t kMicrosecondNs = 1000;

}  // namespace

DeviceLoop::DeviceLoop(device::hid::FirmwareEmulator& device, device::hid::VirtualBus& bus,
                       const LoopSettings& settings)
    : device_(device), bus_(bus), settings_(settings) {
  tick_ns_ = static_cast<std::int64_t>(device_.tick_us()) * kMicrosecondNs;
  in_step_ = !settings_.in_step;
}

Failure DeviceLoop::run() {
  start_ns_ = bus_.now_ns();
  while (!is_over()) {
    if (Failure failed = keep_plugged()) return failed;
    bus_.wait_until_ns(deadline_ns());
    // Requests before the tick come first: a command acts at the next tick.
    take_requests();
    pass_ticks();
  }
  bus_.unplug();
  return {};
}

bool DeviceLoop::is_over() const {
  if (settings_.duration_us != 0 && device_.now_us() >= settings_.duration_us) return true;
  return should_stop && should_stop();
}

std::int64_t DeviceLoop::deadline_ns() const {
  return start_ns_ + static_cast<std::int64_t>(device_.next_tick_us()) * kMicrosecondNs;
}

Failure DeviceLoop::keep_plugged() {
  if (device_.is_plugged() == plugged_) return {};
  plugged_ = !plugged_;
  if (plugged_) return bus_.plug();
  bus_.unplug();
  return {};
}

void DeviceLoop::take_requests() {
  while (const auto request = bus_.next_request()) {
    come_in_step(*request);
    // The device's time of the request is now, but not after the next tick.
    const auto now_us = static_cast<std::uint64_t>((bus_.now_ns() - start_ns_) / kMicrosecondNs);
    const std::uint64_t until_us = std::min(now_us, device_.next_tick_us() - 1);
    if (until_us > device_.now_us()) device_.step(until_us - device_.now_us());
    take(*request);
  }
}

void DeviceLoop::take(const BusRequest& request) {
  switch (request.kind) {
    case RequestKind::kOutput:
      if (device_.write_output(request.bytes)) ++stats_.commands;
      break;
    case RequestKind::kGetFeature: {
      const auto bytes = device_.get_feature(request.report_id);
      bus_.answer_get(request.ticket, bytes ? std::span<const std::uint8_t>(*bytes)
                                            : std::span<const std::uint8_t>());
      break;
    }
    case RequestKind::kSet: {
      const bool taken =
          request.report_id == device::hid::kForceId && device_.write_output(request.bytes);
      if (taken) ++stats_.commands;
      bus_.answer_set(request.ticket, taken);
      break;
    }
  }
}

void DeviceLoop::come_in_step(const BusRequest& request) {
  if (in_step_ || request.kind == RequestKind::kGetFeature) return;
  const auto decoded = device::hid::decode_force(request.bytes);
  if (decoded.report() == nullptr || !decoded.report()->enable) return;
  in_step_ = true;
  const std::int64_t since_tick_ns = bus_.now_ns() - (deadline_ns() - tick_ns_);
  start_ns_ += since_tick_ns - tick_ns_ / 2;
}

// During a delay of more than a tick, the host fetched no report.
void DeviceLoop::pass_ticks() {
  std::int64_t behind_ns = bus_.now_ns() - deadline_ns();
  if (behind_ns < 0) return;
  stats_.largest_latency_ns = std::max(stats_.largest_latency_ns, behind_ns);
  for (; behind_ns >= 0; behind_ns -= tick_ns_) {
    const bool late = behind_ns >= tick_ns_;
    if (late) ++stats_.late_ticks;
    device_.hold_reports(late);
    device_.step(device_.next_tick_us() - device_.now_us());
    ++stats_.ticks;
    while (const auto report = device_.take_input()) bus_.send(report->view());
    if (on_tick) on_tick();
    if (settings_.duration_us != 0 && device_.now_us() >= settings_.duration_us) return;
  }
}

}  // namespace hapticwall::emulator
