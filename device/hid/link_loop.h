// The loop's side of a link: the newest position, whether a force may act, and the command for the
// writer. Only values are exchanged; nothing here waits, allocates or asks the operating system for
// anything but the time.
#pragma once

#include <cstdint>

#include "core/device_reading.h"
#include "device/link_exchange.h"
#include "device/link_figures.h"
#include "device/link_options.h"

namespace hapticwall::device {

// What DeviceReading is for one axis.
struct AxesReading {
  AxisValues position_m{};  // of the newest state there ever was
  double age_s = 0.0;
  double device_time_s = 0.0;  // since the device's clock began; begins anew with the device
  DeviceState state = DeviceState::kFault;
};

// One thread. Realtime-safe: yes, all of it.
class LinkLoop {
 public:
  LinkLoop(LinkExchange& exchange, const HostClock& now_ns);

  // See ImpulseEngine.
  [[nodiscard]] AxesReading read();
  void write(const AxisValues& force_n);
  void enable(bool enabled);
  [[nodiscard]] const LinkFigures& figures() const { return figures_; }

 private:
  [[nodiscard]] Trouble judge(std::int64_t age_ns);
  void collect_figures(double age_s);

  LinkExchange& exchange_;
  const HostClock& now_ns_;
  const std::int64_t opened_ns_;
  LinkStatus status_;
  Trouble trouble_ = Trouble::kNotFound;
  std::int64_t read_ns_ = 0;
  std::uint32_t seen_session_ = 0;  // the newest one that a state came from
  std::uint32_t lost_session_ = 0;
  bool asked_ = false;    // what enable() said last
  bool enabled_ = false;  // asked for since the last trouble
  LinkFigures figures_;
};

}  // namespace hapticwall::device
