// The loop's side of a link: the newest position, whether a force may act, and the command for the
// writer. It reads the clock, and exchanges values without waiting or allocating.
#pragma once

#include <cstdint>

#include "core/tick/device_reading.h"
#include "device/link/link.h"

namespace hapticwall::device {

// A DeviceReading of both axes.
struct AxesReading {
  AxisValues position_m{};  // of the newest state, also after a loss
  AxisValues applied_n{};
  double age_s = 0.0;
  double device_time_s = 0.0;  // by the device's clock, since its start
  DeviceState state = DeviceState::kFault;
};

// One thread. Realtime-safe: yes, all of it.
class LinkLoop {
 public:
  LinkLoop(LinkExchange& exchange, const HostClock& now_ns);

  // Functions as in ImpulseEngine. A link that was silent for kLinkLostNs stays lost until the
  // owner has opened it again, even if the device speaks.
  [[nodiscard]] AxesReading read();
  // Newtons; positive pushes to smaller positions. No command leaves without an open link.
  void write(const AxisValues& force_n);
  // Enables at a change from false to true without a trouble. A later trouble disables until the
  // next such change.
  void enable(bool enabled);
  [[nodiscard]] const LinkStats& stats() const { return stats_; }

 private:
  [[nodiscard]] Trouble judge(std::int64_t age_ns);
  void collect_stats(double age_s);

  LinkExchange& exchange_;
  const HostClock& now_ns_;
  const std::int64_t opened_ns_;
  LinkStatus status_;
  Trouble trouble_ = Trouble::kNotFound;
  std::int64_t read_ns_ = 0;
  std::uint32_t seen_session_ = 0;  // of the newest state
  LinkStatus lost_;
  bool asked_ = false;    // the last enable()
  bool enabled_ = false;  // enabled since the last trouble
  LinkStats stats_;
};

}  // namespace hapticwall::device
