#include "app/ui/state/hand_lead.h"

#include <algorithm>

namespace hapticwall::ui {
namespace {

constexpr double kMaxLineS = 0.5;  // even if a frame takes longer
constexpr double kLinesPerFrame = 1.5;

session::HandMove rest(double duration_s) { return {.m = {0.0, 0.0}, .duration_s = duration_s}; }

}  // namespace

void HandLead::grab(const Point& here) {
  sent_ = here;
  points_.clear();
  frame_s_ = arrival_s_ = here.time_s;
  burst_s_ = here.time_s;
  grabbed_ = true;
}

void HandLead::follow(const Point& to) {
  const bool same_burst = !points_.empty() && to.time_s - burst_s_ < kBurstS;
  const double before_s = points_.empty() ? sent_->time_s : points_.back().time_s;
  if (!same_burst) {
    burst_s_ = to.time_s;
    points_.emplace_back();
  }
  points_.back() = {std::max(to.time_s, before_s + (same_burst ? 0.0 : kBurstS)), to.place_m};
}

std::vector<session::HandMove> HandLead::take(double now_s) {
  std::vector<session::HandMove> moves;
  const double frame_s = now_s - frame_s_;
  frame_s_ = now_s;
  if (grabbed_) moves.push_back(rest(0.0));
  if (grabbed_) moves.front().at_once = true;
  grabbed_ = false;
  for (const Point& point : points_) {
    if (arrival_s_ <= now_s) {  // the hand has arrived, and rests
      moves.push_back(rest(std::min(frame_s, kRestS)));
      arrival_s_ = now_s + moves.back().duration_s;
    }
    moves.push_back(line_to(point, frame_s));
  }
  points_.clear();
  return moves;
}

session::HandMove HandLead::line_to(const Point& to, double frame_s) {
  const double longest_s = std::clamp(kLinesPerFrame * frame_s, kRestS, kMaxLineS);
  session::HandMove move;
  move.m = {to.place_m.x - sent_->place_m.x, to.place_m.y - sent_->place_m.y};
  move.duration_s = std::min(to.time_s - sent_->time_s, longest_s);
  arrival_s_ += move.duration_s;
  sent_ = to;
  return move;
}

}  // namespace hapticwall::ui
