// Tests which plug-ins the program refuses, and with which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/algorithm/algorithm.h"
#include "core/algorithm/plugin/include/hapticwall/plugin.h"
#include "core/algorithm/plugin/plugin_list.h"

namespace hapticwall {
namespace {

using ::testing::HasSubstr;

constexpr double kPluginNan = std::numeric_limits<double>::quiet_NaN();

class PluginProblem : public ::testing::Test {
 protected:
  std::array<hw_parameter, 17> parameters_{
      {{"gain", "N", 0.0, 1.0, 0.5, "a gain"},
       {"damping_n_s_per_m", "N·s/m", 0.0, 1e6, kPluginNan, "of a built-in algorithm, too"}}};
  std::array<hw_signal, 9> signals_{
      {{"gain_n", "of its own"}, {"step_bound_n", "of a built-in algorithm, too"}}};
  hw_plugin plugin_{
      HAPTICWALL_PLUGIN_ABI,
      sizeof(hw_plugin),
      0,
      2,
      2,
      parameters_.data(),
      signals_.data(),
      "mine",
      "Mine",
      "an idea",
      "F_d = F_e",
      [](void* /*state*/, const hw_context* /*context*/) {},
      [](void* /*state*/) {},
      [](void* /*state*/, const hw_input* in, double* /*signals*/) { return in->wall_force_n; }};
};

TEST_F(PluginProblem, NoneInASoundPlugin) { EXPECT_EQ(plugin_problem(plugin_), ""); }

TEST_F(PluginProblem, AnotherInterface) {
  plugin_.abi = 2;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("built for ABI 2"));
  plugin_.abi = HAPTICWALL_PLUGIN_ABI;
  plugin_.size = 4;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("has 4 bytes"));
}

TEST_F(PluginProblem, AMissingFunction) {
  plugin_.reset = nullptr;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("reset or step is NULL"));
}

TEST_F(PluginProblem, AStateThatIsTooLarge) {
  plugin_.state_bytes = 262145;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("at most 262144 are taken"));
}

TEST_F(PluginProblem, ANameThatIsNoneOrTaken) {
  for (const char* name : {static_cast<const char*>(nullptr), "", "Mine", "a/b", "my law"}) {
    plugin_.name = name;
    EXPECT_THAT(plugin_problem(plugin_), HasSubstr("its name is not a word"));
  }
  plugin_.name = "energy-bounding";
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("is called \"energy-bounding\" already"));
}

TEST_F(PluginProblem, ATextThatWouldCommandATerminal) {
  for (const char* text : {static_cast<const char*>(nullptr), "two\nlines", "\x1b[2J", "\xff"}) {
    plugin_.title = text;
    EXPECT_THAT(plugin_problem(plugin_), HasSubstr("title, idea and equation"));
  }
}

TEST_F(PluginProblem, ARangeThatIsNone) {
  for (const double maximum : {-1.0, 0.0, kPluginNan, std::numeric_limits<double>::infinity()}) {
    parameters_[0].maximum = maximum;
    EXPECT_THAT(plugin_problem(plugin_), HasSubstr("parameter gain: minimum and maximum"));
  }
  parameters_[0].maximum = 0.25;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("fallback 0.5 is outside 0 to 0.25"));
}

TEST_F(PluginProblem, AKeyOfAnotherAlgorithmThatMeansSomethingElse) {
  parameters_[1].maximum = 5.0;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("another algorithm has this key"));
  parameters_[1] = {"then", "", 0.0, 1.0, 0.0, "the key of the follower"};
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("another algorithm has this key"));
}

TEST_F(PluginProblem, KeysThatAreWrongTwiceOrTooMany) {
  parameters_[1] = parameters_[0];
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("has this key twice"));
  parameters_[1].key = "no.key";
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("the key of parameter 1"));
  plugin_.parameter_count = 17;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("17 parameters; at most 16"));
  plugin_.parameter_count = 1;
  plugin_.parameters = nullptr;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("parameters is NULL"));
}

TEST_F(PluginProblem, ASignalThatCouldNotBeAColumn) {
  signals_[1].meaning = "two\nlines";
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("signal step_bound_n: meaning must be one line"));
  signals_[1] = signals_[0];
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("signal gain_n: the plug-in has this signal"));
  for (const char* name : {static_cast<const char*>(nullptr), "", "a,b", "Gain"}) {
    signals_[1].name = name;
    EXPECT_THAT(plugin_problem(plugin_), HasSubstr("the name of signal 1 is not a word"));
  }
  plugin_.signal_count = 9;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("9 signals; at most 8"));
  plugin_.signal_count = 1;
  plugin_.signals = nullptr;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("signals is NULL"));
}

// The built-in algorithms have nine.
TEST_F(PluginProblem, MoreSignalsThanASampleHolds) {
  const std::array<const char*, 8> names{"a", "b", "c", "d", "e", "f", "g", "h"};
  for (std::size_t i = 0; i < names.size(); ++i) signals_.at(i) = {names[i], ""};
  plugin_.signal_count = static_cast<std::uint32_t>(kMaxSignals - algorithm_signals().size());
  EXPECT_EQ(plugin_problem(plugin_), "");
  ++plugin_.signal_count;
  EXPECT_THAT(plugin_problem(plugin_), HasSubstr("have more than 16 signals"));
  signals_.at(plugin_.signal_count - 1).name = "step_bound_n";
  EXPECT_EQ(plugin_problem(plugin_), "") << "a shared one has a place";
}

}  // namespace
}  // namespace hapticwall
