// When the window may rest: nothing comes from the session, and nobody does anything.
#pragma once

namespace hapticwall::ui {

inline constexpr double kAwakeS = 0.6;  // after the last thing that happened
inline constexpr double kFrameS = 1.0 / 60.0;
inline constexpr double kIdleFrameS = 0.5;  // events end the wait early

class Idleness {
 public:
  // Something happened at `now_s`, on any clock that does not go back.
  void wake(double now_s) { awake_until_s_ = now_s + kAwakeS; }
  [[nodiscard]] bool idle(double now_s) const { return now_s >= awake_until_s_; }
  // From the beginning of one frame to that of the next.
  [[nodiscard]] double frame_s(double now_s) const { return idle(now_s) ? kIdleFrameS : kFrameS; }

 private:
  double awake_until_s_ = kAwakeS;
};

}  // namespace hapticwall::ui
