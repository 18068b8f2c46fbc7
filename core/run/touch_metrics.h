// What force, handle and energy do during touches: the numbers behind a verdict for a hand that
// moves. docs/verdicts.md defines them and gives their reasons.
//
// Force, position and acceleration are judged in pieces of 50 ms, by their root-mean-square
// deviation from the least-squares line of the piece: a hand is slow and nearly straight within a
// piece, chatter is not.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hapticwall {

inline constexpr double kPieceS = 0.05;
// A piece is judged if it touches and so many before it touch too: an impact rings until then.
inline constexpr std::uint32_t kTouchingBefore = 4;

// Ticks of a piece: 50 ms, at least 4 ticks.
[[nodiscard]] inline std::uint32_t piece_ticks(double rate_hz) {
  constexpr std::uint32_t kMinTicks = 4;
  return std::max(kMinTicks, static_cast<std::uint32_t>(std::lround(kPieceS * rate_hz)));
}

// Sums of one signal over the ticks of a piece, relative to its first value.
class LineDeviation {
 public:
  void begin(double first) { *this = {first}; }
  // `from_middle`: ticks from the middle of the piece.
  void add(double value, double from_middle) {
    const double relative = value - first_;
    sum_ += relative;
    squares_ += relative * relative;
    moment_ += from_middle * relative;
  }
  // Root-mean-square deviation from the least-squares line through `count` values.
  [[nodiscard]] double deviation(double count) const {
    const double spread = count * (count * count - 1.0) / 12.0;  // Σ from_middle²
    const double left = squares_ - sum_ * sum_ / count - moment_ * moment_ / spread;
    return std::sqrt(std::max(0.0, left / count));
  }

  LineDeviation() = default;

 private:
  LineDeviation(double first) : first_(first) {}

  double first_ = 0.0;
  double sum_ = 0.0;
  double squares_ = 0.0;
  double moment_ = 0.0;
};

// Mean deviations over the judged pieces of a span; 0 without one.
struct PieceStats {
  std::uint64_t judged = 0;  // pieces
  double force_n = 0.0;
  double position_m = 0.0;
  double acceleration_m_per_s2 = 0.0;
};

struct TouchStats {
  PieceStats pieces;       // of the whole run, or from `judged_from_tick` on
  PieceStats tail_pieces;  // that begin in the tail
  std::uint64_t touches = 0;
  std::uint64_t contact_ticks = 0;
  double given_j = 0.0;  // energy that the walls gave to the hand, summed over the touches
};

// One tick of one axis.
struct TouchTick {
  double position_m = 0.0;
  double force_n = 0.0;
  double velocity_m_per_s = 0.0;  // true; 0 if unknown
  double absorbed_j = 0.0;        // by actuator and losses up to this tick, any constant added
  bool in_contact = false;
};

// Realtime-safe: yes.
class TouchMetrics {
 public:
  // Pieces that begin before `judged_from_tick` are not judged, and cost nothing.
  TouchMetrics(double rate_hz, std::uint64_t judged_from_tick, std::uint64_t tail_begin_tick)
      : rate_hz_(rate_hz),
        piece_ticks_(piece_ticks(rate_hz)),
        judged_from_tick_(judged_from_tick),
        tail_begin_tick_(tail_begin_tick) {}

  // Call it for every tick, in order.
  void add(std::uint64_t tick, const TouchTick& now) {
    if (place_ == 0) begin_piece(tick, now);
    if (now.in_contact) {
      piece_touches_ = true;
      ++run_.contact_ticks;
      if (!touching_) [[unlikely]]
        begin_touch(now);
    }
    if (touching_) lowest_j_ = std::min(lowest_j_, now.absorbed_j);
    if (collects_) {
      const double from_middle = static_cast<double>(place_) - 0.5 * (piece_ticks_ - 1.0);
      force_.add(now.force_n, from_middle);
      position_.add(now.position_m, from_middle);
      acceleration_.add((now.velocity_m_per_s - last_velocity_m_per_s_) * rate_hz_, from_middle);
    }
    last_velocity_m_per_s_ = now.velocity_m_per_s;
    if (++place_ == piece_ticks_) [[unlikely]]
      end_piece();
  }

  [[nodiscard]] TouchStats stats() const {
    TouchStats stats = run_;
    if (touching_) stats.given_j += given_j();
    take_means(stats.pieces);
    take_means(stats.tail_pieces);
    return stats;
  }

 private:
  void begin_piece(std::uint64_t tick, const TouchTick& now) {
    piece_touches_ = false;
    in_tail_ = tick >= tail_begin_tick_;
    collects_ = touching_before_ >= kTouchingBefore && tick >= judged_from_tick_;
    if (!collects_) return;
    force_.begin(now.force_n);
    position_.begin(now.position_m);
    acceleration_.begin((now.velocity_m_per_s - last_velocity_m_per_s_) * rate_hz_);
  }
  void end_piece() {
    place_ = 0;
    if (!piece_touches_) {
      touching_before_ = 0;
      if (touching_) run_.given_j += given_j();
      touching_ = false;
      return;
    }
    ++touching_before_;
    if (!collects_) return;
    const double count = piece_ticks_;
    const PieceStats piece{1, force_.deviation(count), position_.deviation(count),
                           acceleration_.deviation(count)};
    add_to(run_.pieces, piece);
    if (in_tail_) add_to(run_.tail_pieces, piece);
  }
  static void add_to(PieceStats& sum, const PieceStats& piece) {
    sum.judged += piece.judged;
    sum.force_n += piece.force_n;
    sum.position_m += piece.position_m;
    sum.acceleration_m_per_s2 += piece.acceleration_m_per_s2;
  }
  static void take_means(PieceStats& sum) {
    if (sum.judged == 0) return;
    const auto count = static_cast<double>(sum.judged);
    sum.force_n /= count;
    sum.position_m /= count;
    sum.acceleration_m_per_s2 /= count;
  }
  void begin_touch(const TouchTick& now) {
    touching_ = true;
    ++run_.touches;
    touched_j_ = lowest_j_ = now.absorbed_j;
  }
  [[nodiscard]] double given_j() const { return touched_j_ - lowest_j_; }

  double rate_hz_;
  std::uint32_t piece_ticks_;
  std::uint64_t judged_from_tick_;
  std::uint64_t tail_begin_tick_;
  std::uint32_t place_ = 0;  // ticks of the piece so far
  std::uint32_t touching_before_ = 0;
  bool piece_touches_ = false;
  bool collects_ = false;
  bool in_tail_ = false;
  bool touching_ = false;  // a touch ends with the first whole piece without contact
  double touched_j_ = 0.0;
  double lowest_j_ = 0.0;
  double last_velocity_m_per_s_ = 0.0;
  LineDeviation force_;
  LineDeviation position_;
  LineDeviation acceleration_;
  TouchStats run_;
};

}  // namespace hapticwall
