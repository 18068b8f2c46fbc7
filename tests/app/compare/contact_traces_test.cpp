// Two slots: assignment of samples, and the place of the ghost.
#include "app/compare/contact_traces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/algorithm/algorithm.h"
#include "core/scene.h"

namespace hapticwall::compare {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

AlgorithmSettings named(const char* name) {
  AlgorithmSettings settings;
  settings.index = find_algorithm(name).value();
  return settings;
}

// The rate is 1 kHz: 250 ticks are a rest.
class Slots : public ::testing::Test {
 protected:
  void show(int ticks, double penetration_m, double force_n) {
    for (int i = 0; i < ticks; ++i) {
      Sample sample;
      sample.tick = tick_++;
      sample.generation = generation_;
      sample.penetration_m = penetration_m;
      sample.force_n = force_n;
      sample.energy_cv_j = energy_j_ += 0.5;
      sample.flags = penetration_m > 0.0 ? std::uint32_t{kFlagInContact} : 0U;
      comparison_.add(sample);
    }
  }
  void rest() { show(250, -0.01, 0.0); }
  // The loop takes over some ticks after the toggle.
  void take_over() { ++generation_; }

  ContactTraces comparison_{named("none"), named("virtual-coupling"), 1000.0};
  std::uint64_t tick_ = 0;
  std::uint32_t generation_ = 4;
  double energy_j_ = 0.0;
};

TEST_F(Slots, TheToggleSaysWhatToRun) {
  EXPECT_EQ(comparison_.active(), Slot::kA);
  EXPECT_EQ(comparison_.toggle(), named("virtual-coupling"));
  EXPECT_EQ(comparison_.active(), Slot::kB);
  comparison_.set_settings(Slot::kA, named("energy-bounding"));
  EXPECT_EQ(comparison_.toggle(), named("energy-bounding"));
  EXPECT_EQ(comparison_.activate(Slot::kA), named("energy-bounding"));
}

TEST_F(Slots, TheOtherSlotsContactLiesOverThePresentOne) {
  rest();
  show(40, 0.002, 3.0);
  EXPECT_FALSE(comparison_.ghost());
  rest();
  comparison_.toggle();
  show(10, -0.01, 0.0);
  take_over();
  rest();
  const std::uint64_t onset_tick = tick_;
  show(20, 0.001, 2.0);
  const auto ghost = comparison_.ghost();
  ASSERT_TRUE(ghost);
  EXPECT_EQ(ghost->slot, Slot::kA);
  EXPECT_EQ(ghost->present_onset_tick, onset_tick);
  ASSERT_GE(ghost->points.size(), 40U);
  EXPECT_EQ(ghost->points[0].ticks, 0U);
  EXPECT_EQ(ghost->points[39].ticks, 39U);
  EXPECT_EQ(ghost->points[39].force_n, 3.0);
  EXPECT_EQ(ghost->points[0].energy_cv_j, 0.5);  // since the tick before
  EXPECT_EQ(comparison_.trace(Slot::kB).front().force_n, 2.0);
}

TEST_F(Slots, SamplesBelongToTheSlotBeforeUntilTheLoopHasChanged) {
  rest();
  comparison_.toggle();
  show(30, 0.002, 3.0);  // still under A's algorithm
  EXPECT_THAT(comparison_.trace(Slot::kA), SizeIs(30));
  EXPECT_THAT(comparison_.trace(Slot::kB), IsEmpty());
}

TEST_F(Slots, AContactInWhichParametersChangeIsKeptUpToThere) {
  rest();
  show(30, 0.002, 3.0);
  comparison_.toggle();
  take_over();
  show(30, 0.002, 1.0);
  EXPECT_THAT(comparison_.trace(Slot::kA), SizeIs(30));
  EXPECT_THAT(comparison_.trace(Slot::kB), IsEmpty());
  rest();
  show(5, 0.002, 1.0);
  EXPECT_THAT(comparison_.trace(Slot::kB), SizeIs(5));
}

TEST_F(Slots, ChatterIsOneContact) {
  rest();
  const std::uint64_t onset_tick = tick_;
  for (int i = 0; i < 5; ++i) {
    show(10, 0.002, 3.0);
    show(100, -0.001, 0.0);
  }
  EXPECT_THAT(comparison_.trace(Slot::kA), SizeIs(550));
  comparison_.toggle();
  take_over();
  show(1, -0.001, 0.0);
  EXPECT_EQ(comparison_.ghost()->present_onset_tick, onset_tick);
}

TEST_F(Slots, AResetForgetsThePresentContactAndNotTheTraces) {
  rest();
  show(30, 0.002, 3.0);
  tick_ = 0;
  comparison_.toggle();
  take_over();
  show(1, -0.01, 0.0);
  EXPECT_FALSE(comparison_.ghost());
  show(1, 0.001, 1.0);
  ASSERT_TRUE(comparison_.ghost());
  EXPECT_EQ(comparison_.ghost()->present_onset_tick, 1U);
  EXPECT_THAT(comparison_.ghost()->points, SizeIs(30));
}

TEST_F(Slots, EqualSlotsNeedNoChangeOfTheLoop) {
  comparison_.set_settings(Slot::kB, named("none"));
  rest();
  comparison_.toggle();
  show(7, 0.002, 3.0);
  EXPECT_THAT(comparison_.trace(Slot::kB), SizeIs(7));
}

TEST_F(Slots, ATraceHasABound) {
  rest();
  const TracePoint* data = comparison_.trace(Slot::kA).data();
  show(20000, 0.002, 3.0);
  EXPECT_THAT(comparison_.trace(Slot::kA), SizeIs(8000));
  EXPECT_EQ(comparison_.trace(Slot::kA).data(), data);
}

TEST(SlotDescription, NamesTheKeysThatAreSet) {
  EXPECT_EQ(describe(named("none")), "none");
  AlgorithmSettings settings = named("passivity-control");
  const auto parameters = algorithm_parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].key == "observer") settings.values[i] = 1.0;
    if (parameters[i].key == "damping_credit") settings.values[i] = 1.0;
    if (parameters[i].key == "max_damping_n_s_per_m") settings.values[i] = 0.25;
  }
  const std::string text = describe(settings);
  EXPECT_THAT(text, ::testing::StartsWith("passivity-control ("));
  EXPECT_THAT(text, ::testing::HasSubstr("observer = held-force"));
  EXPECT_THAT(text, ::testing::HasSubstr("damping_credit = true"));
  EXPECT_THAT(text, ::testing::HasSubstr("max_damping_n_s_per_m = 0.25"));
}

}  // namespace
}  // namespace hapticwall::compare
