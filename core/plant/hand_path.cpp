#include "core/plant/hand_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hapticwall {
namespace {

// Points within this distance of a tick, in ticks, count as on it, because decimal times round in
// binary.
constexpr double kOnTickTolerance = 1e-9;

double snap_to_tick(double ticks) {
  const double nearest = std::round(ticks);
  return std::abs(ticks - nearest) <= kOnTickTolerance ? nearest : ticks;
}

}  // namespace

HandPath::HandPath(double position_m, double rate_hz)
    : HandPath(SharedPath{{0.0, position_m}}, rate_hz) {}

HandPath::HandPath(SharedPath path, double rate_hz) : rate_hz_(rate_hz), path_(std::move(path)) {
  now_.period_s = 1.0 / rate_hz;
  reset();
}

// Infinite behind the last one.
double HandPath::begin_tick(std::size_t point) const {
  const bool recorded = path_.recorded != nullptr;
  if (point == (recorded ? path_.recorded->pieces.size() : path_.size())) {
    return std::numeric_limits<double>::infinity();
  }
  if (recorded) return path_.recorded->pieces[point].from_tick;
  return snap_to_tick(path_[point].time_s * rate_hz_);
}

// Computed when the hand arrives there: a measured hand has a point for every tick.
void HandPath::next_segment() {
  segment_ = path_.recorded ? recorded_segment() : segment_of_points();
  next_begin_tick_ = begin_tick(++next_point_);
}

HandPath::Segment HandPath::recorded_segment() const {
  const PathPiece& piece = path_.recorded->pieces[next_point_];
  return {piece.begin_tick, piece.position_m, piece.velocity_m_per_s};
}

HandPath::Segment HandPath::segment_of_points() const {
  const PathPoint& from = path_[next_point_];
  if (next_point_ + 1 == path_.size()) return {next_begin_tick_, from.position_m, 0.0};
  const PathPoint& to = path_[next_point_ + 1];
  return {next_begin_tick_, from.position_m,
          (to.position_m - from.position_m) / (to.time_s - from.time_s)};
}

void HandPath::reset() {
  now_.tick = 0;
  segment_ = {0.0, path_.recorded ? 0.0 : path_.front().position_m, 0.0};
  next_point_ = 0;
  next_begin_tick_ = begin_tick(0);
  lead_ = Lead::kScript;
  piece_begin_ = 0.0;
  set_piece();
}

double HandPath::scripted_position_m(double tick) const {
  return segment_.position_m +
         segment_.velocity_m_per_s * ((tick - segment_.begin_tick) * now_.period_s);
}

// Sets position, speed and end of the straight piece that begins at now_.tick + piece_begin_.
void HandPath::set_piece() {
  const double now = static_cast<double>(now_.tick) + piece_begin_;
  while (next_begin_tick_ <= now) next_segment();
  const double tick_end = static_cast<double>(now_.tick + 1);
  const double next = next_begin_tick_;
  bends_ = next < tick_end || piece_begin_ > 0.0;
  piece_end_ = next < tick_end ? next - static_cast<double>(now_.tick) : 1.0;
  now_.position_m = scripted_position_m(now);
  now_.velocity_m_per_s = segment_.velocity_m_per_s;
  now_.segment_begin_tick = segment_.begin_tick;
  now_.segment_position_m = segment_.position_m;
  now_.straight_until_tick = bends_ || any_period_ ? 0 : straight_until();
}

void HandPath::allow_any_period() {
  any_period_ = true;
  now_.straight_until_tick = 0;
}

void HandPath::pass(double fraction) {
  if (piece_begin_ + fraction >= piece_end_) {
    if (!next_piece()) next_tick();
    return;
  }
  piece_begin_ += fraction;
  if (lead_ == Lead::kScript) return set_piece();
  now_.position_m += now_.velocity_m_per_s * (fraction * now_.period_s);
}

bool HandPath::next_piece() {
  if (piece_end_ >= 1.0) return false;
  piece_begin_ = piece_end_;
  set_piece();
  return true;
}

// The first tick that is not wholly inside the present segment, or never.
std::uint64_t HandPath::straight_until() const {
  if (std::isinf(next_begin_tick_)) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(std::floor(next_begin_tick_));
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

// Moves for one tick towards the pointer, or back to the script, at a limited speed.
void HandPath::aim() {
  now_.straight_until_tick = 0;
  bends_ = false;
  piece_begin_ = 0.0;
  piece_end_ = 1.0;
  const double end_tick = static_cast<double>(now_.tick + 1);
  double target_m = pointer_m_;
  if (lead_ == Lead::kReturning) {
    while (next_begin_tick_ <= end_tick) next_segment();
    target_m = scripted_position_m(end_tick);
  }
  const double reach_m = kMaxPointerSpeedMPerS * now_.period_s;
  next_position_m_ = now_.position_m + std::clamp(target_m - now_.position_m, -reach_m, reach_m);
  now_.velocity_m_per_s = (next_position_m_ - now_.position_m) * rate_hz_;
  if (lead_ == Lead::kReturning && next_position_m_ == target_m) lead_ = Lead::kScript;
}

}  // namespace hapticwall
