#include "app/ui/state/time_view.h"

#include <algorithm>

namespace hapticwall::ui {
namespace {

constexpr double kPeriods = 10.0;
constexpr double kEnough = 0.8;   // share of the periods that a shorter usual length may show
constexpr double kChanged = 1.6;  // factor of the frequency that asks for another length

}  // namespace

void follow_rhythm(TimeView& time, std::optional<double> frequency_hz) {
  if (!frequency_hz || *frequency_hz <= 0.0) return time.rhythm_s.reset();
  const double wanted_s = kPeriods / *frequency_hz;
  const double now_s = time.rhythm_s.value_or(0.0);
  if (wanted_s < kChanged * now_s && now_s < kChanged * wanted_s) return;
  const auto* usual = std::ranges::lower_bound(kTimeWindowsS, kEnough * wanted_s);
  time.rhythm_s = usual != kTimeWindowsS.end() ? *usual : kTimeWindowsS.back();
}

double window_length_s(const TimeView& time) {
  const double chosen_s = std::clamp(time.window_s, kTimeWindowsS.front(), kTimeWindowsS.back());
  return time.follows_rhythm && time.rhythm_s ? std::min(*time.rhythm_s, chosen_s) : chosen_s;
}

void follow_newest(TimeView& time, double newest_time_s) {
  const draw::TimeWindow window = draw::newest_window(newest_time_s, window_length_s(time));
  time.from_s = window.from_s;
  time.to_s = window.to_s;
}

}  // namespace hapticwall::ui
