#include "device/link/link_loop.h"

#include <algorithm>

#include "core/units.h"
#include "device/link/link_command.h"

namespace hapticwall::device {
namespace {

double seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / kNanosecondsPerSecond;
}

}  // namespace

LinkLoop::LinkLoop(LinkExchange& exchange, const HostClock& now_ns)
    : exchange_(exchange), now_ns_(now_ns), opened_ns_(now_ns()) {}

AxesReading LinkLoop::read() {
  exchange_.views.update();
  status_ = exchange_.status;
  const LinkView& view = exchange_.views.current();
  read_ns_ = now_ns_();
  const std::int64_t since_ns = view.session == 0 ? opened_ns_ : view.received_ns;
  const std::int64_t age_ns = std::max<std::int64_t>(read_ns_ - since_ns, 0);
  trouble_ = judge(age_ns);
  if (trouble_ != Trouble::kNone) enabled_ = false;
  collect_stats(seconds(age_ns));
  AxesReading reading;
  reading.position_m = view.position_m;
  reading.applied_n = view.applied_n;
  reading.age_s = stats_.age_s;
  reading.device_time_s = static_cast<double>(view.device_time_us) / kMicrosecondsPerSecond;
  reading.state = trouble_ == Trouble::kNone ? DeviceState::kOk : DeviceState::kFault;
  return reading;
}

// A silent link stays lost, even if it sends again, until the owner has reopened it.
Trouble LinkLoop::judge(std::int64_t age_ns) {
  const LinkView& view = exchange_.views.current();
  const Trouble reason = status_.reason == Trouble::kNone ? Trouble::kSilent : status_.reason;
  if (status_.session == 0 || view.session != status_.session) return reason;
  if (lost_.session == view.session) return lost_.reason;
  if (view.trouble != Trouble::kNone) return view.trouble;
  if (age_ns > kLinkLostNs) {
    lost_ = {view.session, exchange_.listening.cause(read_ns_)};
    exchange_.lost = lost_;
    return lost_.reason;
  }
  // The link was lost and came back since the last read: report it once.
  const bool came_back_unseen = seen_session_ != 0 && seen_session_ != view.session;
  seen_session_ = view.session;
  return came_back_unseen ? reason : Trouble::kNone;
}

void LinkLoop::collect_stats(double age_s) {
  const LinkView& view = exchange_.views.current();
  const double maximum_age_s = stats_.maximum_age_s;
  stats_ = view.stats;
  stats_.trouble = trouble_;
  stats_.connected =
      status_.session != 0 && view.session == status_.session && lost_.session != view.session;
  stats_.calibrated = stats_.calibrated && stats_.connected;
  stats_.enabled = stats_.enabled && stats_.connected;
  stats_.age_s = age_s;
  stats_.maximum_age_s = stats_.connected ? std::max(maximum_age_s, age_s) : maximum_age_s;
  stats_.write_time_s = seconds(exchange_.write_ns.load(std::memory_order_relaxed));
  stats_.maximum_write_time_s = seconds(exchange_.longest_write_ns.load(std::memory_order_relaxed));
  stats_.losses = exchange_.losses.load(std::memory_order_relaxed);
}

void LinkLoop::enable(bool enabled) {
  if (!enabled) enabled_ = false;
  if (enabled && !asked_) enabled_ = trouble_ == Trouble::kNone;
  asked_ = enabled;
}

void LinkLoop::write(const AxisValues& force_n) {
  if (status_.session == 0) return;
  const LinkView& view = exchange_.views.current();
  LinkCommand command;
  command.session = status_.session;
  command.made_ns = read_ns_;
  command.enable = enabled_;
  // Clears faults only while no force is asked for, so that clearing never starts a force.
  command.clear_faults = !asked_ && is_device_fault(trouble_);
  command.force_n = force_n;
  command.limit_n = view.limit_n;
  command.state_sequence = view.sequence;
  command.state_latch_us = view.latch_us;
  exchange_.commands.publish(command);
  exchange_.command_signal.post();
}

}  // namespace hapticwall::device
