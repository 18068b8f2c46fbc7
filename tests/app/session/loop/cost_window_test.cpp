#include "app/session/loop/cost_window.h"

#include <gtest/gtest.h>

namespace hapticwall::session {
namespace {

constexpr std::int64_t kMillisecondNs = 1'000'000;

TEST(CostWindow, TellsNothingBeforeAQuarterIsOver) {
  CostWindow window;
  window.add(5, 100);
  window.add(5 + CostWindow::kQuarterNs - 1, 100);
  EXPECT_EQ(window.stats().ticks, 0U);
  window.add(5 + CostWindow::kQuarterNs, 100);
  EXPECT_EQ(window.stats().ticks, 2U);
}

TEST(CostWindow, MedianAndMaximumOfTheLastSecondOnly) {
  CostWindow window;
  std::int64_t now_ns = 0;
  const auto pass = [&](int ticks, std::int64_t cost_ns) {
    for (int i = 0; i < ticks; ++i) window.add(now_ns += kMillisecondNs, cost_ns);
  };
  pass(1, 90'000);
  pass(999, 20'000);
  pass(1, 1000);
  EXPECT_EQ(window.stats().maximum_ns, 90'000);
  pass(1000, 1000);
  EXPECT_EQ(window.stats().ticks, 1000U);
  EXPECT_EQ(window.stats().maximum_ns, 1000);
  EXPECT_NEAR(static_cast<double>(window.stats().median_ns), 1000.0, 32.0);
}

TEST(CostWindow, HalfOfTheTicksAreNotAboveTheMedian) {
  CostWindow window;
  for (std::int64_t i = 0; i < 1001; ++i) {
    window.add(i * kMillisecondNs / 2, i % 100 < 49 ? 500 : 30);
  }
  EXPECT_EQ(window.stats().median_ns, 30);
  EXPECT_EQ(window.stats().maximum_ns, 500);
}

// A pause clears the window; a negative cost is harmless.
TEST(CostWindow, AfterAPauseItStartsAnew) {
  CostWindow window;
  std::int64_t now_ns = 0;
  for (int i = 0; i < 2000; ++i) window.add(now_ns += kMillisecondNs, 50'000);
  now_ns += 3'600'000'000'000;
  for (int i = 0; i < 300; ++i) window.add(now_ns += kMillisecondNs, -3);
  EXPECT_EQ(window.stats().maximum_ns, 0);
  EXPECT_EQ(window.stats().median_ns, 0);
  EXPECT_EQ(window.stats().ticks, 250U);
}

}  // namespace
}  // namespace hapticwall::session
