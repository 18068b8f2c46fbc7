#include "app/session/recorded_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hapticwall::session {
namespace {

// Adds a piece, unless the last one continues or goes on resting.
void add_piece(const PathPiece& piece, std::vector<PathPiece>& pieces) {
  if (!pieces.empty() && piece.velocity_m_per_s == pieces.back().velocity_m_per_s) {
    const bool rests = piece.velocity_m_per_s == 0.0;
    const bool goes_on = rests || piece.begin_tick == pieces.back().begin_tick;
    if (goes_on && piece.position_m == pieces.back().position_m) return;
  }
  pieces.push_back(piece);
}

// The present piece of a path at `tick`.
PathPiece piece_of(const HandPath& path, std::uint64_t tick, bool is_led) {
  const auto now = static_cast<double>(tick);
  if (is_led) return {now, now, path.position_m(), path.velocity_m_per_s()};
  const StraightPath& script = path.straight();
  return {std::max(now, script.segment_begin_tick), script.segment_begin_tick,
          script.segment_position_m, script.velocity_m_per_s};
}

}  // namespace

RecordedHand::RecordedHand(const Scene& scene, std::uint64_t first_tick,
                           std::vector<double> positions_m)
    : script_(hand_path(scene)),
      reach_m_(kMaxPointerSpeedMPerS * scene.sampling.period_s()),
      first_tick_(first_tick),
      positions_m_(std::move(positions_m)) {
  HandPath before = script_;
  const double start_m = before.position_m();
  for (std::uint64_t tick = 0; tick < first_tick; ++tick) before.next_tick();
  if (before.position_m() != positions_m_.front()) start_m_ = start_m;
  script_.next_tick();
}

std::optional<double> RecordedHand::position_m(std::uint64_t tick) const {
  if (tick >= first_tick_) {
    const std::uint64_t row = tick - first_tick_;
    return row < positions_m_.size() ? std::optional(positions_m_[row]) : std::nullopt;
  }
  if (!start_m_) return std::nullopt;
  const double fraction = static_cast<double>(tick) / static_cast<double>(first_tick_);
  return *start_m_ + fraction * (positions_m_.front() - *start_m_);
}

// Position that the hand reaches in a tick, by the same arithmetic as HandPath.
double RecordedHand::reached_m(double from_m, double target_m) const {
  return from_m + std::clamp(target_m - from_m, -reach_m_, reach_m_);
}

// The pointer position that takes the hand exactly from one position to the other. It is farther
// away if the hand continues in the same direction.
double RecordedHand::target_m(double from_m, double to_m) const {
  constexpr double kFar = 2.0;
  const std::optional<double> after_m = position_m(tick_ + 2);
  const double up_m = std::nextafter(to_m, kFar);
  const double down_m = std::nextafter(to_m, -kFar);
  for (const double target_m : {after_m.value_or(to_m), to_m, up_m, down_m,
                                std::nextafter(up_m, kFar), std::nextafter(down_m, -kFar)}) {
    if (reached_m(from_m, target_m) == to_m) return target_m;
  }
  return to_m;
}

// Target for the present tick; nullopt: the script leads. Goes to the next tick.
std::optional<double> RecordedHand::next_target_m(double from_m) {
  const double scripted_m = script_.position_m();
  const double to_m = position_m(tick_ + 1).value_or(leads_ ? from_m : scripted_m);
  leads_ = to_m != scripted_m || (leads_ && reached_m(from_m, to_m) != to_m);
  has_led_ = has_led_ || leads_;
  const auto target = leads_ ? std::optional(target_m(from_m, to_m)) : std::nullopt;
  script_.next_tick();
  ++tick_;
  return target;
}

void RecordedHand::lead(PlantModel& plant) {
  const bool led = leads_;
  const std::optional<double> target = next_target_m(plant.truth().hand_path_m);
  if (target) {
    plant.lead_hand_to(*target);
  } else if (led) {
    plant.release_hand();
  }
}

bool RecordedHand::lead(HandPath& path) {
  const bool led = leads_;
  const std::optional<double> target = next_target_m(path.position_m());
  if (target) {
    path.lead_to(*target);
  } else if (led) {
    path.release();
  }
  return led || leads_;
}

std::vector<PathPiece> pieces_of(RecordedHand hand, HandPath path, std::uint64_t end_tick) {
  std::vector<PathPiece> pieces;
  for (std::uint64_t tick = 0; tick < end_tick; ++tick) {
    const bool is_led = hand.lead(path);
    do {
      add_piece(piece_of(path, tick, is_led), pieces);
    } while (path.next_piece());
    path.next_tick();
  }
  const auto end = static_cast<double>(end_tick);
  add_piece({end, end, path.position_m(), 0.0}, pieces);
  return pieces;
}

}  // namespace hapticwall::session
