#include "device/port/wheel_drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.h"

namespace hapticwall::device {
namespace {

constexpr double kHalfTurnDeg = 180.0;

}  // namespace

double WheelDescription::travel_m() const {
  return travel_deg / kHalfTurnDeg * std::numbers::pi * radius_m;
}

WheelScale::WheelScale(const WheelDescription& wheel, evdev::WheelAxis axis)
    : encoder_m_(wheel.travel_m() / std::max(static_cast<double>(axis.max) - axis.min, 1.0)),
      middle_(std::ceil((static_cast<double>(axis.max) + axis.min) / 2.0)),
      full_n_(wheel.full_n() * wheel.sign),
      limit_n_(wheel.limit_n()) {}

std::int16_t WheelScale::level(double force_n) const {
  if (!std::isfinite(force_n)) return 0;
  const double share = std::clamp(force_n, -limit_n_, limit_n_) / full_n_;
  return static_cast<std::int16_t>(std::trunc(share * evdev::kFullLevel));
}

WheelWriter::WheelWriter(evdev::WheelNode& node, const WheelScale& scale, double rate_hz,
                         std::int64_t now_ns)
    : node_(node),
      scale_(scale),
      interval_ns_(static_cast<std::int64_t>(kNanosecondsPerSecond / rate_hz)),
      free_ns_(now_ns + kSilenceNs) {}

WheelWriter::~WheelWriter() {
  while (take_away() == Sent::kTaken) {
  }
}

// The end of a force does not wait. A positive force of a report pushes towards growing counts.
bool WheelWriter::write(const hid::ForceReport& command, std::int64_t now_ns) {
  if (command.enable && now_ns < free_ns_) return true;
  const Sent sent =
      command.enable ? send(scale_.level(0.0 - command.force_n[0]), now_ns) : take_away();
  if (sent != Sent::kNothing) free_ns_ = std::max(free_ns_, now_ns) + interval_ns_;
  return sent != Sent::kRefused;
}

// Before each play the level is sent again, because a full queue of the kernel drops reports and
// says that it took them. The driver sends no level twice, so the neighbour nearer to 0 is sent.
WheelWriter::Sent WheelWriter::send(std::int16_t level, std::int64_t now_ns) {
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
  return level != level_ ? set_level(level) : Sent::kNothing;
}

WheelWriter::Sent WheelWriter::take_away() {
  if (level_ != 0) return set_level(0);
  if (plays_) return play(false);
  return has_gain_ ? set_gain(false) : Sent::kNothing;
}

WheelWriter::Sent WheelWriter::set_level(std::int16_t level) {
  level_ = level;
  return sent(node_.set_level(level));
}

WheelWriter::Sent WheelWriter::play(bool starts) {
  plays_ = starts;
  is_fresh_ = false;
  return sent(node_.play(starts));
}

WheelWriter::Sent WheelWriter::set_gain(bool full) {
  has_gain_ = full;
  return sent(node_.set_gain(full));
}

WheelWriter::Sent WheelWriter::sent(bool taken) {
  taken_n_ = taken && plays_ && has_gain_ ? scale_.force_n(level_) : 0.0;
  return taken ? Sent::kTaken : Sent::kRefused;
}

}  // namespace hapticwall::device
