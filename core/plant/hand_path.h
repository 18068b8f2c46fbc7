// The hand's intended position: a script that is linear between its points, or a pointer. Within a
// tick it moves at constant speed, unless a point of the script falls between two ticks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/scene.h"

namespace hapticwall {

// The hand approaches the pointer no faster than an arm.
inline constexpr double kMaxPointerSpeedMPerS = 1.0;

// The intended motion at a tick, and at the following ticks of the same straight segment.
// Realtime-safe: yes.
struct StraightPath {
  std::uint64_t tick = 0;
  // The first tick that is not wholly inside the present segment; 0 while a pointer leads.
  std::uint64_t straight_until_tick = 0;
  double segment_begin_tick = 0.0;
  double segment_position_m = 0.0;
  double period_s = 1.0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;

  // True if the next tick is also wholly inside the segment.
  [[nodiscard]] bool goes_on() const { return tick + 1 < straight_until_tick; }
  // Advances to the next tick. Precondition: goes_on().
  void next_tick() {
    ++tick;
    if (velocity_m_per_s == 0.0) return;
    const auto ticks = static_cast<double>(static_cast<std::int64_t>(tick));
    position_m = segment_position_m + velocity_m_per_s * ((ticks - segment_begin_tick) * period_s);
  }
};

class HandPath {
 public:
  // A path that stays at `position_m`: without a hand, or with one that a pointer leads.
  HandPath(double position_m, double rate_hz);
  // Precondition: `path` is not empty. Times within 1e-9 ticks of a tick count as on it.
  HandPath(SharedPath path, double rate_hz);

  // Realtime-safe: yes, all that follows.
  // From now on ticks need not have the nominal period: pass() moves along, and goes_on() is false.
  void allow_any_period();
  // Back to the start of the script, which leads again.
  void reset();
  // Intended position at the present instant, and its speed until remaining_in_piece() is over.
  [[nodiscard]] double position_m() const { return now_.position_m; }
  [[nodiscard]] double velocity_m_per_s() const { return now_.velocity_m_per_s; }
  // True if a point of the script lies strictly inside the present tick.
  [[nodiscard]] bool bends_within_tick() const { return bends_; }
  // Length of the present straight piece as a fraction of the tick; 1 without a bend.
  [[nodiscard]] double piece_fraction() const { return piece_end_ - piece_begin_; }
  // Advances to the next piece of the same tick; false at the end of the tick.
  bool next_piece();
  // Moves on by a part of the present piece, or to the piece or nominal tick after it. `fraction`:
  // of a nominal period, greater than 0 and at most piece_fraction().
  void pass(double fraction);
  // Advances to the next tick.
  void next_tick() {
    if (now_.goes_on()) {
      now_.next_tick();
    } else {
      enter_tick();
    }
  }
  // A copy that a loop advances along the straight segment, and its return.
  [[nodiscard]] const StraightPath& straight() const { return now_; }
  void resume(const StraightPath& straight) { now_ = straight; }

  // The path approaches this position, at most at kMaxPointerSpeedMPerS, until the next call.
  void lead_to(double position_m);
  // The path approaches the script, whose time has gone on, at the same speed. No effect unless a
  // pointer leads.
  void release();

 private:
  enum class Lead : std::uint8_t { kScript, kPointer, kReturning };

  struct Segment {
    double begin_tick;  // in ticks; whole if the point falls on a tick
    double position_m;
    double velocity_m_per_s;
  };

  [[nodiscard]] double begin_tick(std::size_t point) const;
  void next_segment();
  [[nodiscard]] Segment recorded_segment() const;
  [[nodiscard]] Segment segment_of_points() const;
  [[nodiscard]] double scripted_position_m(double tick) const;
  [[nodiscard]] std::uint64_t straight_until() const;
  void enter_tick();
  void set_piece();
  void aim();

  double rate_hz_ = 1.0;
  SharedPath path_;

  StraightPath now_;
  Segment segment_{};  // the present one
  std::size_t next_point_ = 0;
  double next_begin_tick_ = 0.0;
  double piece_begin_ = 0.0;
  double piece_end_ = 1.0;
  bool bends_ = false;
  bool any_period_ = false;
  Lead lead_ = Lead::kScript;
  double pointer_m_ = 0.0;
  double next_position_m_ = 0.0;  // at the end of the tick, if the script does not lead
};

}  // namespace hapticwall
