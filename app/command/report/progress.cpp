#include "app/command/report/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/units.h"

namespace hapticwall::command {
namespace {

constexpr std::chrono::milliseconds kFirstAfter{500};  // short work shows nothing
constexpr std::chrono::milliseconds kInterval{100};
constexpr int kBarWidth = 30;
// Too little for an estimate.
constexpr double kMinShare = 0.01;
constexpr double kSecondsPerMinute = 60.0;
constexpr int kMinutesPerHour = 60;

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < kSecondsPerMinute) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<long long>(seconds / kSecondsPerMinute);
  if (minutes < kMinutesPerHour) {
    return fmt::format("{} min {:02.0f} s", minutes,
                       std::floor(seconds - kSecondsPerMinute * static_cast<double>(minutes)));
  }
  return fmt::format("{} h {:02} min", minutes / kMinutesPerHour, minutes % kMinutesPerHour);
}

std::optional<double> remaining_s(double passed_s, double began_at, double done) {
  if (done - began_at < kMinShare) return std::nullopt;
  return passed_s * (1.0 - done) / (done - began_at);
}

Progress::Progress(std::string label, bool wanted)
    : label_(std::move(label)),
      enabled_(wanted && isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()),
      next_(begin_ + kFirstAfter) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double fraction) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  const double part = std::clamp(fraction, 0.0, 1.0);
  const int full = static_cast<int>(part * kBarWidth);
  std::string text = fmt::format("\r{} [{:#<{}}{:.<{}}] {:3.0f} %", label_, "", full, "",
                                 kBarWidth - full, part * kPercent);
  const std::chrono::duration<double> passed = now - begin_;
  if (const auto rest_s = remaining_s(passed.count(), began_at_, part)) {
    text += ", " + duration_text(*rest_s) + " left";
  }
  text += "\x1b[K";
  std::fputs(text.c_str(), stderr);
}

}  // namespace hapticwall::command
