// The algorithm of a plug-in: its state, its signals and its exceptions.
#include "core/algorithm/plugin/plugin_algorithm.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall {
namespace {

// Zero before the first configure().
struct Calls {
  double configured, resets, steps;
};
Calls& calls_in(void* state) { return *static_cast<Calls*>(state); }

constexpr hw_signal kShownTick{"step_bound_n", "the tick; infinite in tick 2"};

double step_of_calls(void* state, const hw_input* in, double* signals) {
  ++calls_in(state).steps;
  signals[0] =
      in->tick == 2 ? std::numeric_limits<double>::infinity() : static_cast<double>(in->tick);
  return 100.0 * calls_in(state).configured + 10.0 * calls_in(state).resets + calls_in(state).steps;
}

hw_plugin plugin_of_calls() {
  return {HAPTICWALL_PLUGIN_ABI,
          sizeof(hw_plugin),
          sizeof(Calls),
          0,
          1,
          nullptr,
          &kShownTick,
          "test-calls",
          "Calls",
          "for tests",
          "",
          [](void* state, const hw_context* /*context*/) { ++calls_in(state).configured; },
          [](void* state) { ++calls_in(state).resets; },
          step_of_calls};
}

class PluginAlgorithmTest : public ::testing::Test {
 protected:
  void configure(const hw_plugin& plugin) {
    law_.choose(&plugin);
    law_.configure({});
  }
  double step() {
    signals_.fill(std::numeric_limits<double>::quiet_NaN());
    return law_.step({}, signals_);
  }
  [[nodiscard]] double shown() const {
    return std::isfinite(signals_[0]) ? signals_[0] : std::numeric_limits<double>::quiet_NaN();
  }

  Signals signals_{};
  const hw_plugin plugin_ = plugin_of_calls();
  PluginAlgorithm law_;
};

TEST_F(PluginAlgorithmTest, StartsOnceWithZerosAndAReset) {
  configure(plugin_);
  configure(plugin_);
  EXPECT_EQ(step(), 211.0) << "configured twice, reset once";
  const hw_plugin rebuilt = plugin_;
  configure(rebuilt);
  EXPECT_EQ(step(), 111.0) << "knows nothing of the older one";
}

TEST_F(PluginAlgorithmTest, CountsTicksFromTheLastResetAndShowsWhatIsFinite) {
  configure(plugin_);
  for (const double tick : {0.0, 1.0}) {
    step();
    EXPECT_EQ(shown(), tick);
  }
  step();
  EXPECT_TRUE(std::isnan(shown()));
  law_.reset();
  step();
  EXPECT_EQ(shown(), 0.0);
}

// Loaded after the algorithm was made.
TEST_F(PluginAlgorithmTest, IsNotCalledWithoutRoomForItsState) {
  hw_plugin large = plugin_;
  large.state_bytes = static_cast<std::uint32_t>(plugin_state_capacity()) + 1;
  configure(large);
  EXPECT_TRUE(std::isnan(step()));
}

TEST_F(PluginAlgorithmTest, IsNotCalledAfterAnExceptionUntilItsRebuild) {
  static int calls = 0;
  hw_plugin throws = plugin_;
  throws.step = [](void* /*state*/, const hw_input* /*in*/, double* /*signals*/) -> double {
    ++calls;
    throw std::runtime_error("a fault");
  };
  configure(throws);
  for (int tick = 0; tick < 3; ++tick) EXPECT_TRUE(std::isnan(step()));
  EXPECT_EQ(calls, 1);
  configure(plugin_);
  EXPECT_EQ(step(), 111.0);
}

// A force that was computed with another rounding mode is no result.
TEST_F(PluginAlgorithmTest, IsNotCalledAfterItChangedTheRoundingModeWhichIsRestored) {
  static int calls = 0;
  hw_plugin rounds = plugin_;
  rounds.step = [](void* /*state*/, const hw_input* /*in*/, double* /*signals*/) {
    ++calls;
    std::fesetround(FE_DOWNWARD);
    return 1.0;
  };
  configure(rounds);
  for (int tick = 0; tick < 3; ++tick) EXPECT_TRUE(std::isnan(step()));
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

}  // namespace
}  // namespace hapticwall
