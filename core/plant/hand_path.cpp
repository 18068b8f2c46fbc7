#include "core/plant/hand_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapticwall {
namespace {

// Points within this distance of a tick, in ticks, count as on it: decimal times round in binary.
constexpr double kOnTickTolerance = 1e-9;

double snap_to_tick(double ticks) {
  const double nearest = std::round(ticks);
  return std::abs(ticks - nearest) <= kOnTickTolerance ? nearest : ticks;
}

}  // namespace

HandPath::HandPath(double position_m, double rate_hz)
    : rate_hz_(rate_hz), segments_{{0.0, position_m, 0.0}} {
  now_.period_s = 1.0 / rate_hz;
  reset();
}

HandPath::HandPath(const std::vector<PathPoint>& points, double rate_hz) : rate_hz_(rate_hz) {
  now_.period_s = 1.0 / rate_hz;
  segments_.reserve(points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    const double velocity_m_per_s = last ? 0.0
                                         : (points[i + 1].position_m - points[i].position_m) /
                                               (points[i + 1].time_s - points[i].time_s);
    if (i == 0 && points[i].time_s > 0.0) segments_.push_back({0.0, points[i].position_m, 0.0});
    segments_.push_back(
        {snap_to_tick(points[i].time_s * rate_hz), points[i].position_m, velocity_m_per_s});
  }
  reset();
}

void HandPath::reset() {
  now_.tick = 0;
  segment_ = 0;
  lead_ = Lead::kScript;
  piece_begin_ = 0.0;
  set_piece();
}

double HandPath::scripted_position_m(double tick) const {
  const Segment& segment = segments_[segment_];
  return segment.position_m +
         segment.velocity_m_per_s * ((tick - segment.begin_tick) * now_.period_s);
}

// Sets position, speed and end of the straight piece that begins at now_.tick + piece_begin_.
void HandPath::set_piece() {
  const double now = static_cast<double>(now_.tick) + piece_begin_;
  while (segment_ + 1 < segments_.size() && segments_[segment_ + 1].begin_tick <= now) ++segment_;
  const double tick_end = static_cast<double>(now_.tick + 1);
  const double next =
      segment_ + 1 < segments_.size() ? segments_[segment_ + 1].begin_tick : tick_end;
  bends_ = next < tick_end || piece_begin_ > 0.0;
  piece_end_ = next < tick_end ? next - static_cast<double>(now_.tick) : 1.0;
  now_.position_m = scripted_position_m(now);
  const Segment& segment = segments_[segment_];
  now_.velocity_m_per_s = segment.velocity_m_per_s;
  now_.segment_begin_tick = segment.begin_tick;
  now_.segment_position_m = segment.position_m;
  now_.straight_until_tick = bends_ ? 0 : straight_until();
}

bool HandPath::next_piece() {
  if (piece_end_ >= 1.0) return false;
  piece_begin_ = piece_end_;
  set_piece();
  return true;
}

// The first tick that is not wholly inside the present segment, or never.
std::uint64_t HandPath::straight_until() const {
  if (segment_ + 1 >= segments_.size()) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(std::floor(segments_[segment_ + 1].begin_tick));
}

void HandPath::enter_tick() {
  ++now_.tick;
  if (lead_ == Lead::kScript) {
    piece_begin_ = 0.0;
    set_piece();
    return;
  }
  now_.position_m = next_position_m_;
  aim();
}

void HandPath::lead_to(double position_m) {
  pointer_m_ = position_m;
  lead_ = Lead::kPointer;
  aim();
}

void HandPath::release() {
  if (lead_ != Lead::kPointer) return;
  lead_ = Lead::kReturning;
  aim();
}

// One tick towards the pointer, or back to the script, at a limited speed.
void HandPath::aim() {
  now_.straight_until_tick = 0;
  bends_ = false;
  piece_begin_ = 0.0;
  piece_end_ = 1.0;
  const double end_tick = static_cast<double>(now_.tick + 1);
  double target_m = pointer_m_;
  if (lead_ == Lead::kReturning) {
    while (segment_ + 1 < segments_.size() && segments_[segment_ + 1].begin_tick <= end_tick) {
      ++segment_;
    }
    target_m = scripted_position_m(end_tick);
  }
  const double reach_m = kMaxPointerSpeedMPerS * now_.period_s;
  next_position_m_ = now_.position_m + std::clamp(target_m - now_.position_m, -reach_m, reach_m);
  now_.velocity_m_per_s = (next_position_m_ - now_.position_m) * rate_hz_;
  if (lead_ == Lead::kReturning && next_position_m_ == target_m) lead_ = Lead::kScript;
}

}  // namespace hapticwall
