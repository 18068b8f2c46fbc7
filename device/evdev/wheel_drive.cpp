#include "device/evdev/wheel_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.h"

namespace hapticwall::device {
namespace {

// Looks for commands that grew old.
constexpr std::int64_t kLookNs = 5'000'000;
constexpr double kHalfTurnDeg = 180.0;

}  // namespace

WheelScale::WheelScale(const WheelDescription& wheel, evdev::WheelAxis axis)
    : travel_m_(wheel.travel_deg / kHalfTurnDeg * std::numbers::pi * wheel.radius_m),
      encoder_m_(travel_m_ / std::max(static_cast<double>(axis.max) - axis.min, 1.0)),
      middle_((static_cast<double>(axis.max) + axis.min) / 2.0),
      full_n_(wheel.torque_nm / wheel.radius_m * wheel.sign),
      limit_n_(std::min(wheel.force_limit_n, std::abs(full_n_))) {}

std::int16_t WheelScale::level(double force_n) const {
  if (!std::isfinite(force_n)) return 0;
  const double share = std::clamp(force_n, -limit_n_, limit_n_) / full_n_;
  return static_cast<std::int16_t>(std::trunc(share * evdev::kFullLevel));
}

WheelWriter::WheelWriter(evdev::WheelNode& node, const WheelScale& scale, LinkExchange& exchange,
                         std::uint32_t session, double rate_hz, std::int64_t now_ns)
    : node_(node),
      scale_(scale),
      exchange_(exchange),
      session_(session),
      interval_ns_(static_cast<std::int64_t>(kNanosecondsPerSecond / rate_hz)),
      free_ns_(now_ns + kSilenceNs) {
  exchange_.taken_n = 0.0;
}

// A force rests on a position that is younger than kLinkLostNs.
std::int16_t WheelWriter::wanted(std::int64_t now_ns, bool& pushes) {
  if (exchange_.commands.update()) newest_ = exchange_.commands.current();
  pushes = newest_.session == session_ && newest_.enable &&
           now_ns - newest_.made_ns <= kLinkLostNs && !stop_.load(std::memory_order_acquire);
  return pushes ? scale_.level(newest_.force_n[0]) : std::int16_t{0};
}

WheelWriter::Next WheelWriter::step(const HostClock& now_ns) {
  const std::int64_t began_ns = now_ns();
  if (began_ns < free_ns_) return {free_ns_, false};
  bool pushes = false;
  const std::int16_t level = wanted(began_ns, pushes);
  if (!send(level, pushes, began_ns)) {
    if (stop_.load(std::memory_order_acquire)) over_.store(true, std::memory_order_release);
    return {began_ns + kLookNs, true};
  }
  const std::int64_t took_ns = now_ns() - began_ns;
  exchange_.write_ns.store(took_ns, std::memory_order_relaxed);
  exchange_.longest_write_ns.store(
      std::max(took_ns, exchange_.longest_write_ns.load(std::memory_order_relaxed)),
      std::memory_order_relaxed);
  free_ns_ = began_ns + std::max(interval_ns_, took_ns);
  return {free_ns_, false};
}

// Before each play the level is sent again, because a full queue of the kernel drops reports and
// says that it took them. The driver sends no level twice, so it is the one beside, nearer to 0.
bool WheelWriter::send(std::int16_t level, bool pushes, std::int64_t now_ns) {
  if (!pushes) return take_away();
  if (!has_gain_) return set_gain(true);
  const bool plays = !plays_ || now_ns >= replay_ns_;
  if (plays && !is_fresh_) {
    is_fresh_ = true;
    return set_level(static_cast<std::int16_t>(level > 0 ? level - 1 : level + 1));
  }
  if (plays) {
    replay_ns_ = now_ns + kReplayNs;
    return play(true);
  }
  return level != level_ && set_level(level);
}

bool WheelWriter::take_away() {
  if (level_ != 0) return set_level(0);
  if (plays_) return play(false);
  return has_gain_ && set_gain(false);
}

bool WheelWriter::set_level(std::int16_t level) {
  level_ = level;
  return sent(node_.set_level(level));
}

bool WheelWriter::play(bool starts) {
  plays_ = starts;
  is_fresh_ = false;
  return sent(node_.play(starts));
}

bool WheelWriter::set_gain(bool full) {
  has_gain_ = full;
  return sent(node_.set_gain(full));
}

bool WheelWriter::sent(bool taken) {
  if (!taken) over_.store(true, std::memory_order_release);
  exchange_.taken_n = taken && plays_ && has_gain_ ? scale_.force_n(level_) : 0.0;
  return true;
}

}  // namespace hapticwall::device
