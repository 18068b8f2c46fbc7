// Traces of other runs in the plots, on the screen and in the exported figure.
#include "app/draw/plot/extra_traces.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/algorithm/algorithm.h"
#include "tests/app/ui/gui_test.h"

namespace hapticwall::test {
namespace {

using draw::ExtraSource;
using draw::ExtraTrace;
using draw::PlotId;
using draw::Quantity;

constexpr int kTicks = 6000;

// Scene 'press' under an algorithm, as long as the session of the test.
std::shared_ptr<const draw::SampleHistory> run(const std::string& algorithm) {
  Scene scene = file::load_scene("press")->scene;
  scene.algorithm.index = *find_algorithm(algorithm);
  FakeSession session(scene);
  session.advance(kTicks);
  std::vector<Tick> ticks(kTicks);
  EXPECT_EQ(session.take_ticks(ticks), ticks.size());
  auto history = std::make_shared<draw::SampleHistory>(ticks.size());
  for (const Tick& tick : ticks) history->push(tick.x());
  return history;
}

ExtraTrace trace(std::string label, std::shared_ptr<const draw::SampleHistory> history) {
  ExtraTrace made;
  made.label = std::move(label);
  made.history = std::move(history);
  return made;
}

class ExtraTracesTest : public GuiTest {
 protected:
  [[nodiscard]] std::vector<ExtraTrace>& all() {
    return application_->state().plots.transient.extra_traces;
  }
  [[nodiscard]] double force_axis() {
    return application_->state()
        .plots.transient.axes[static_cast<std::size_t>(PlotId::kForce)]
        .left.maximum;
  }
};

TEST(ExtraTraces, EachSourceReplacesItsOwn) {
  std::vector<ExtraTrace> all;
  replace_extra_traces(all, ExtraSource::kReplay, {trace("a", nullptr)});
  replace_extra_traces(all, ExtraSource::kComparison, {trace("b", nullptr), trace("c", nullptr)});
  replace_extra_traces(all, ExtraSource::kReplay, {trace("d", nullptr)});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].label + all[1].label + all[2].label, "bcd");
  replace_extra_traces(all, ExtraSource::kComparison, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].source, ExtraSource::kReplay);
}

TEST_F(ExtraTracesTest, TheLegendNamesThemWhereTheyAre) {
  live(kTicks);
  EXPECT_FALSE(find("under none").has_value());
  replace_extra_traces(all(), ExtraSource::kReplay, {trace("under none", run("none"))});
  frames(1);
  EXPECT_TRUE(find("under none").has_value());
  for (const Quantity quantity :
       {Quantity(&Sample::position_m), Quantity(&Sample::force_n),
        Quantity(draw::Derived::kStiffness), Quantity(&Sample::energy_cv_j)})
    application_->state().plots.persisted.hidden_lines |= draw::line_bit(quantity);
  frames(1);
  EXPECT_FALSE(find("under none").has_value()) << "hidden with the session's own lines";
}

TEST_F(ExtraTracesTest, TheValueAxesHaveRoomForThem) {
  live(kTicks);
  const double alone_n = force_axis();
  constexpr double kSpikeN = 700.0;
  ASSERT_LT(alone_n, kSpikeN);
  auto other = std::make_shared<draw::SampleHistory>(kTicks);
  for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) / 1000.0;
    sample.force_n = tick == kTicks / 2 ? kSpikeN : 0.0;
    other->push(sample);
  }
  replace_extra_traces(all(), ExtraSource::kReplay, {trace("spike", other)});
  frames(2);
  EXPECT_GE(force_axis(), kSpikeN);
  EXPECT_TRUE(find("spike").has_value());
  all().front().shift_s = 100.0;  // out of sight
  frames(2);
  EXPECT_EQ(force_axis(), alone_n);
  EXPECT_FALSE(find("spike").has_value()) << "nor in a legend";
}

TEST_F(ExtraTracesTest, NothingIsDrawnOfOneWithoutSamples) {
  live(1000);
  replace_extra_traces(all(), ExtraSource::kReplay,
                       {trace("no history", nullptr),
                        trace("empty", std::make_shared<const draw::SampleHistory>(10))});
  frames(2);
  EXPECT_FALSE(find("no history").has_value());
  EXPECT_FALSE(find("empty").has_value());
}

}  // namespace
}  // namespace hapticwall::test
