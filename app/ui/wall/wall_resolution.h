// The share of its pixels with which the wall is drawn, so that slow graphics stay fluent.
#pragma once

#include <algorithm>

namespace hapticwall::ui {

// A longer frame lowers the resolution. A frame of 30 a second is not slow.
inline constexpr double kSlowFrameS = 0.033;

class WallResolution {
 public:
  static constexpr float kMinShare = 0.5F;
  static constexpr double kMinHoldS = 1.0;
  static constexpr double kMaxHoldS = 60.0;

  // Share of width and height: 1 or 1/2. At 1/4 the edges are blocks.
  [[nodiscard]] float share() const { return share_; }

  // A frame that took `frame_s` ends at `now_s`, on any monotonic clock. Slow frames halve the
  // share. It doubles again after a time without one, which is longer each time that it was too
  // early.
  void note_frame(double frame_s, double now_s) {
    if (frame_s > kSlowFrameS) {
      if (raised_) hold_s_ = std::min(2.0 * hold_s_, kMaxHoldS);
      share_ = std::max(0.5F * share_, kMinShare);
      raised_ = false;
      since_s_ = now_s;
    } else if (now_s - since_s_ >= hold_s_) {
      raised_ = share_ < 1.0F;
      if (!raised_) hold_s_ = kMinHoldS;
      share_ = std::min(2.0F * share_, 1.0F);
      since_s_ = now_s;
    }
  }

 private:
  float share_ = 1.0F;
  double hold_s_ = kMinHoldS;
  double since_s_ = 0.0;  // time of the last change or slow frame
  bool raised_ = false;   // the last change was a rise
};

}  // namespace hapticwall::ui
