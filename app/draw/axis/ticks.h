// Ticks of an axis that are chosen for its length, so that their labels do not collide.
#pragma once

#include <implot.h>

#include <functional>
#include <string>
#include <vector>

namespace hapticwall::draw {

// A number beside an axis.
struct AxisTick {
  double value = 0.0;  // on the axis
  std::string text;

  friend bool operator==(const AxisTick&, const AxisTick&) = default;
};

// The round numbers within [minimum, maximum] in steps of 1, 2 or 5 times a power of ten: at most
// `max_count`, or a few more if it is the only way to have two. Precondition: minimum < maximum,
// max_count >= 2.
[[nodiscard]] std::vector<AxisTick> round_ticks(double minimum, double maximum, int max_count);

// A scale that is linear below `knee` and logarithmic above, on both sides of 0. `knee` > 0.
[[nodiscard]] double to_symlog(double value, double knee);
// Ticks of such an axis, whose limits are to_symlog() of values: 0 and powers of ten. Those without
// room have no label. `gap`: the least distance of two labels, on the axis.
[[nodiscard]] std::vector<AxisTick> symlog_ticks(double minimum, double maximum, double knee,
                                                 double gap);

// "0.1", "1000", "10⁻⁹", "2·10⁵".
[[nodiscard]] std::string decimal_text(int digit, int exponent);

// True if the labels do not collide on an axis of this length in pixels from the left to the right,
// in the current font. `scale`: place of a value from 0 to 1.
[[nodiscard]] bool have_room_across(const std::vector<AxisTick>& ticks, float width,
                                    const std::function<double(double)>& scale);
// round_ticks() with as many labels as have room.
[[nodiscard]] std::vector<AxisTick> ticks_across(double minimum, double maximum, float width);
// Labels of an axis of this height that have room.
[[nodiscard]] int max_ticks_up(float height);

// Between BeginPlot() and SetupFinish().
void set_up_ticks(ImAxis axis, const std::vector<AxisTick>& ticks);

}  // namespace hapticwall::draw
