// The first contact on samples made up.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/study/contact_study.h"

namespace hapticwall {
namespace {

constexpr double kContactPeriodS = 1e-3;

struct Touch {
  double force_n;
  bool in_contact;
  std::uint32_t more_flags = 0;
};

FirstContact contact_of(const std::vector<Touch>& touches, double speed_m_per_s) {
  FirstContact contact(kContactPeriodS);
  for (std::size_t i = 0; i < touches.size(); ++i) {
    Sample sample;
    sample.tick = i;
    sample.force_n = touches[i].force_n;
    sample.truth.velocity_m_per_s = speed_m_per_s;
    sample.flags = (touches[i].in_contact ? kFlagInContact : 0U) | touches[i].more_flags;
    contact.add(sample);
  }
  return contact;
}

TEST(FirstContact, TakesTheSteepestMeanFromTheFirstTickInContact) {
  // 0.2 N a tick at first, then 0.3: 0.5 N in two ticks; the jump into contact does not count.
  const FirstContact contact =
      contact_of({{0, false}, {5, true}, {5.2, true}, {5.5, true}, {5.5, true}, {5.6, true}}, 0.5);
  EXPECT_DOUBLE_EQ(contact.approach_speed_m_per_s().value(), 0.5);
  EXPECT_NEAR(contact.rate_hardness_n_per_m().value(), 250.0 / 0.5, 1e-9);
  EXPECT_EQ(contact.kind(), RiseKind::kMean);
}

TEST(FirstContact, EndsWhereTheCommandFalls) {
  const FirstContact contact = contact_of(
      {{0, false}, {1, true}, {2, true}, {1.5, true}, {9, true}, {0, false}, {1, true}, {9, true}},
      1.0);
  EXPECT_NEAR(contact.rate_hardness_n_per_m().value(), 1000.0, 1e-9);
}

TEST(FirstContact, EndsWhereTheHandleIsOutAgain) {
  // A force that goes on rising outside is no wall's.
  const FirstContact contact =
      contact_of({{0, false}, {1, true}, {2, true}, {9, false}, {20, true}}, 1.0);
  EXPECT_NEAR(contact.rate_hardness_n_per_m().value(), 1000.0, 1e-9);
}

TEST(FirstContact, EndsAtTheForceLimit) {
  const FirstContact contact =
      contact_of({{0, false}, {1, true}, {1, true}, {4, true, kFlagForceLimit}, {90, true}}, 1.0);
  EXPECT_NEAR(contact.rate_hardness_n_per_m().value(), 1500.0, 1e-9);
  EXPECT_EQ(contact.kind(), RiseKind::kToTheLimit);
  // The rise before the limit was steeper: the limit has cut off nothing.
  const FirstContact before =
      contact_of({{0, false}, {1, true}, {4, true}, {5, true, kFlagForceLimit}}, 1.0);
  EXPECT_NEAR(before.rate_hardness_n_per_m().value(), 3000.0, 1e-9);
  EXPECT_EQ(before.kind(), RiseKind::kMean);
}

TEST(FirstContact, OfAJumpThatNearlyReachesTheLimitIsNotWhatIsLeft) {
  const FirstContact contact =
      contact_of({{0, false}, {8.7, true}, {8.9, true, kFlagForceLimit}, {0, false}}, 1.0);
  EXPECT_NEAR(contact.rate_hardness_n_per_m().value(), 8.9 / (2.0 * kContactPeriodS), 1e-6);
  EXPECT_EQ(contact.kind(), RiseKind::kToTheLimit);
}

TEST(FirstContact, OfOneJumpIsThatJumpInATick) {
  const FirstContact at_once = contact_of(
      {{0, false}, {8.9, true, kFlagForceLimit}, {8.9, true, kFlagForceLimit}, {0, false}}, 0.1);
  EXPECT_NEAR(at_once.rate_hardness_n_per_m().value(), 8.9 / kContactPeriodS / 0.1, 1e-6);
  EXPECT_EQ(at_once.kind(), RiseKind::kOneTick);
  const FirstContact one_count = contact_of({{0.5, false}, {2, true}, {2, true}, {0, false}}, 0.1);
  EXPECT_NEAR(one_count.rate_hardness_n_per_m().value(), 1.5 / kContactPeriodS / 0.1, 1e-6);
  EXPECT_EQ(one_count.kind(), RiseKind::kOneTick);
}

TEST(FirstContact, WaitsForASlowHandButLooksNoFurther) {
  std::vector<Touch> touches{{0, false}, {1, true}};
  for (int i = 0; i < 49; ++i) touches.push_back({1, true});
  touches.push_back({3, true});  // 50 ticks after the first
  touches.push_back({99, true});
  const double expected = 2.0 / 0.05;
  EXPECT_NEAR(contact_of(touches, 1.0).rate_hardness_n_per_m().value(), expected, 1e-9);
  touches[4].force_n = 1.003;  // a rise in time counts, and no later one does
  for (std::size_t i = 5; i < 51; ++i) touches[i].force_n = 1.003;
  EXPECT_NEAR(contact_of(touches, 1.0).rate_hardness_n_per_m().value(), 1.0, 1e-9);
}

TEST(FirstContact, NeedsAnEntryAndASpeed) {
  const FirstContact outside = contact_of({{0, false}, {0, false}}, 1.0);
  EXPECT_FALSE(outside.approach_speed_m_per_s());
  const FirstContact begun_inside = contact_of({{1, true}, {2, true}, {3, true}}, 1.0);
  EXPECT_FALSE(begun_inside.approach_speed_m_per_s());
  EXPECT_FALSE(begun_inside.rate_hardness_n_per_m());
  const FirstContact outwards = contact_of({{0, false}, {1, true}, {2, true}}, -1e-3);
  EXPECT_TRUE(outwards.approach_speed_m_per_s());
  EXPECT_FALSE(outwards.rate_hardness_n_per_m());
}

}  // namespace
}  // namespace hapticwall
