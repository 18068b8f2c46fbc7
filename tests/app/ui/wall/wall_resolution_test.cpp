#include "app/ui/wall/wall_resolution.h"

#include <gtest/gtest.h>

namespace hapticwall::ui {
namespace {

// Frames of a cost that depends on the share, for some time; returns the number of changes.
template <typename Cost>
int run(WallResolution& resolution, double& now_s, double for_s, Cost cost_s) {
  int changes = 0;
  for (const double end_s = now_s + for_s; now_s < end_s;) {
    const float before = resolution.share();
    const double frame_s = cost_s(before);
    now_s += frame_s;
    resolution.note_frame(frame_s, now_s);
    changes += resolution.share() != before ? 1 : 0;
  }
  return changes;
}

TEST(WallResolution, ASlowFrameHalvesItAndQuickOnesBringItBack) {
  WallResolution resolution;
  double now_s = 5.0;
  resolution.note_frame(0.033, now_s);
  EXPECT_EQ(resolution.share(), 1.0F);
  resolution.note_frame(0.034, now_s += 0.034);
  EXPECT_EQ(resolution.share(), 0.5F);
  for (int i = 0; i < 5; ++i) resolution.note_frame(0.05, now_s += 0.05);
  EXPECT_EQ(resolution.share(), WallResolution::kMinShare);
  run(resolution, now_s, 0.9, [](float) { return 0.01; });
  EXPECT_EQ(resolution.share(), WallResolution::kMinShare);
  run(resolution, now_s, 2.0, [](float) { return 0.01; });
  EXPECT_EQ(resolution.share(), 1.0F);
}

// If full resolution stays too slow, the picture changes less and less often.
TEST(WallResolution, ItDoesNotFlicker) {
  WallResolution resolution;
  double now_s = 0.0;
  const auto cost_s = [](float share) { return share > 0.5F ? 0.05 : 0.015; };
  EXPECT_LE(run(resolution, now_s, 60.0, cost_s), 14);
  EXPECT_LE(run(resolution, now_s, 600.0, cost_s), 24);
}

}  // namespace
}  // namespace hapticwall::ui
