#include "app/draw/axis/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace hapticwall::draw {
namespace {

constexpr double kRoundOff = 1e-9;  // steps; a limit on a tick includes it

// With a minus as wide as a plus.
std::string signed_text(const std::string& magnitude, bool negative) {
  return negative ? "−" + magnitude : magnitude;
}

// `value` with as many decimals as the step has. Far from 1: "3·10⁵".
std::string tick_text(double value, double step, double largest) {
  constexpr double kMaxPlain = 1e5;
  constexpr double kMinPlain = 1e-4;
  const double magnitude = std::abs(value);
  if (magnitude < 0.5 * step) return "0";
  if (largest < kMaxPlain && step >= kMinPlain) {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + kRoundOff)));
    return signed_text(fmt::format("{:.{}f}", magnitude, decimals), value < 0.0);
  }
  const int exponent = static_cast<int>(std::floor(std::log10(largest) + kRoundOff));
  const double mantissa = magnitude / std::pow(10.0, exponent);
  const std::string power = decimal_text(1, exponent);
  const std::string text = fmt::format("{:.3g}", mantissa);
  return signed_text(text == "1" ? power : text + "·" + power, value < 0.0);
}

std::vector<AxisTick> ticks_of_step(double minimum, double maximum, double step) {
  const double first = std::ceil(minimum / step - kRoundOff);
  const double last = std::floor(maximum / step + kRoundOff);
  const double largest = std::max(std::abs(first), std::abs(last)) * step;
  std::vector<AxisTick> ticks;
  for (double i = first; i <= last; i += 1.0)
    ticks.push_back({i * step, tick_text(i * step, step, largest)});
  return ticks;
}

}  // namespace

std::string decimal_text(int digit, int exponent) {
  constexpr int kMinPlain = -2;
  constexpr int kMaxPlain = 3;
  if (exponent >= kMinPlain && exponent <= kMaxPlain) {
    return fmt::format("{:g}", digit * std::pow(10.0, exponent));
  }
  constexpr std::array<const char*, 10> kSuperscripts{"⁰", "¹", "²", "³", "⁴",
                                                      "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = digit == 1 ? "10" : fmt::format("{}·10", digit);
  if (exponent < 0) text += "⁻";
  for (const char figure : fmt::format("{}", std::abs(exponent))) {
    text += kSuperscripts.at(static_cast<std::size_t>(figure - '0'));
  }
  return text;
}

std::vector<AxisTick> round_ticks(double minimum, double maximum, int max_count) {
  const double span = maximum - minimum;
  std::vector<AxisTick> finer;
  for (double power = std::pow(10.0, std::floor(std::log10(span / max_count)) - 1.0);;
       power *= 10.0) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = factor * power;
      if (span / step > 3.0 * max_count) continue;
      std::vector<AxisTick> ticks = ticks_of_step(minimum, maximum, step);
      if (ticks.size() < 2 && finer.size() >= 2) return finer;  // one number is no scale
      if (ticks.size() <= static_cast<std::size_t>(max_count)) return ticks;
      finer = std::move(ticks);
    }
  }
}

double to_symlog(double value, double knee) {
  return std::copysign(std::log10(1.0 + std::abs(value) / knee), value);
}

std::vector<AxisTick> symlog_ticks(double minimum, double maximum, double knee, double gap) {
  const int lowest = static_cast<int>(std::ceil(std::log10(knee) - kRoundOff));
  const double farthest = std::max(std::abs(minimum), std::abs(maximum));
  const int highest = static_cast<int>(std::floor(farthest + std::log10(knee) + kRoundOff));
  std::vector<AxisTick> ticks;
  const auto add = [&](double place, const std::string& text) {
    if (place < minimum || place > maximum) return;
    const bool free = std::ranges::none_of(ticks, [&](const AxisTick& other) {
      return !other.text.empty() && std::abs(other.value - place) < gap;
    });
    ticks.push_back({place, free ? text : ""});
  };
  add(0.0, "0");
  // From the highest down, so that the largest values have a number.
  for (int exponent = highest; exponent >= lowest; --exponent) {
    const double place = to_symlog(std::pow(10.0, exponent), knee);
    const std::string text = decimal_text(1, exponent);
    add(place, text);
    add(-place, signed_text(text, true));
  }
  std::ranges::sort(ticks, {}, &AxisTick::value);
  return ticks;
}

bool have_room_across(const std::vector<AxisTick>& ticks, float width,
                      const std::function<double(double)>& scale) {
  constexpr float kGapEms = 0.7F;
  float end = -std::numeric_limits<float>::infinity();
  for (const AxisTick& tick : ticks) {
    const float half = 0.5F * ImGui::CalcTextSize(tick.text.c_str()).x;
    const float middle = width * static_cast<float>(scale(tick.value));
    if (middle - half < end + kGapEms * ImGui::GetFontSize()) return false;
    end = middle + half;
  }
  return true;
}

std::vector<AxisTick> ticks_across(double minimum, double maximum, float width) {
  constexpr int kMaxTicks = 8;
  const auto scale = [&](double value) { return (value - minimum) / (maximum - minimum); };
  for (int count = kMaxTicks; count > 2; --count) {
    std::vector<AxisTick> ticks = round_ticks(minimum, maximum, count);
    if (have_room_across(ticks, width, scale)) return ticks;
  }
  return round_ticks(minimum, maximum, 2);
}

int max_ticks_up(float height) {
  constexpr float kLines = 1.6F;
  constexpr int kMaxTicks = 7;
  return std::clamp(static_cast<int>(height / (kLines * ImGui::GetFontSize())), 2, kMaxTicks);
}

void set_up_ticks(ImAxis axis, const std::vector<AxisTick>& ticks) {
  std::vector<double> values;
  std::vector<const char*> labels;
  for (const AxisTick& tick : ticks) {
    values.push_back(tick.value);
    labels.push_back(tick.text.c_str());
  }
  ImPlot::SetupAxisTicks(axis, values.data(), static_cast<int>(values.size()), labels.data());
}

}  // namespace hapticwall::draw
