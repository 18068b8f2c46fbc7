#include "app/command/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace hapticwall::command {
namespace {

constexpr std::chrono::milliseconds kFirstAfter{500};  // short work shows nothing
constexpr std::chrono::milliseconds kInterval{100};
constexpr int kBarWidth = 30;
constexpr double kPercent = 100.0;

}  // namespace

Progress::Progress(std::string label, bool wanted)
    : label_(std::move(label)),
      enabled_(wanted && isatty(STDERR_FILENO) == 1),
      next_(std::chrono::steady_clock::now() + kFirstAfter) {}

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
  const std::string text = fmt::format("\r{} [{:#<{}}{:.<{}}] {:3.0f} %", label_, "", full, "",
                                       kBarWidth - full, part * kPercent);
  std::fputs(text.c_str(), stderr);
}

}  // namespace hapticwall::command
