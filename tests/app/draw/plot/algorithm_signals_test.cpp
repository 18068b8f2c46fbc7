// Signals of algorithms in the history and in the plots.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/draw/plot/plot_lines.h"

namespace hapticwall::draw {
namespace {

SignalNames named(const std::string& name, std::size_t place = 3) {
  SignalNames names;
  names.at(place) = name;
  return names;
}

struct UnitCase {
  const char* name;
  const char* label;
  PlotId plot;
  const char* unit;
};

TEST(AlgorithmSignals, AreLinesOfThePlotThatHasTheirUnit) {
  for (const UnitCase& unit : {UnitCase{"depth_m", "law: depth", PlotId::kPosition, "mm"},
                               UnitCase{"tip_m_per_s", "law: tip", PlotId::kPosition, "mm/s"},
                               UnitCase{"step_bound_n", "law: step bound", PlotId::kForce, "N"},
                               UnitCase{"alpha_n_s_per_m", "law: alpha", PlotId::kForce, "N·s/m"},
                               UnitCase{"k_n_per_m", "law: k", PlotId::kStiffness, "kN/m"},
                               UnitCase{"e_j", "law: e", PlotId::kPassivity, "mJ"},
                               UnitCase{"loss_w", "law: loss", PlotId::kPassivity, "mW"}}) {
    const PlotTable table(named(unit.name));
    const auto found = table.find(Quantity::signal(3));
    ASSERT_TRUE(found) << unit.name;
    EXPECT_EQ(found->plot->id, unit.plot) << unit.name;
    EXPECT_STREQ(found->line->name, unit.label);
    EXPECT_STREQ(found->scale().unit, unit.unit);
    const ChosenLines chosen = lines_with(named(unit.name));
    EXPECT_NE(chosen.at(static_cast<std::size_t>(unit.plot)) & line_bit(Quantity::signal(3)), 0U);
  }
}

TEST(AlgorithmSignals, OfAnUnknownUnitHaveNoLine) {
  EXPECT_FALSE(PlotTable(named("counter")).find(Quantity::signal(3)));
  EXPECT_EQ(lines_with(named("counter")), usual_lines());
}

TEST(AlgorithmSignals, OfEveryBuiltInAlgorithmAreDrawnOnRequestOnly) {
  const PlotTable table(signal_names());
  for (std::size_t place = 0; place < algorithm_signals().size(); ++place) {
    const auto found = table.find(Quantity::signal(place));
    ASSERT_TRUE(found) << algorithm_signals()[place].name;
    EXPECT_EQ(found->line->meaning, std::string(algorithm_signals()[place].meaning));
    for (const LineSet lines : usual_lines())
      EXPECT_EQ(lines & line_bit(found->line->quantity), 0U);
  }
}

TEST(AlgorithmSignals, AreKeptByTheHistoryWithTheirGaps) {
  SampleHistory history(100);
  EXPECT_EQ(history.signals(), signal_names());
  Sample sample;
  for (sample.tick = 0; sample.tick < 10; ++sample.tick) {
    sample.time_s = static_cast<double>(sample.tick) * 1e-3;
    sample.signals[kMaxSignals - 1] = sample.tick < 5 ? 2.0 : std::nan("");
    history.push(sample);
  }
  EXPECT_EQ(history.value(Quantity::signal(kMaxSignals - 1), 4), 2.0);
  EXPECT_EQ(history.sample(4).signals[kMaxSignals - 1], 2.0);
  EXPECT_TRUE(std::isnan(history.sample(5).signals[kMaxSignals - 1]));
  EXPECT_TRUE(std::isnan(history.sample(4).signals[0]));
  const SampleStats stats = history.stats(Quantity::signal(kMaxSignals - 1), {0, 10});
  EXPECT_EQ(stats.count, 5.0);
  history.name_signals(named("other_n"));
  EXPECT_EQ(history.signals(), named("other_n"));
}

}  // namespace
}  // namespace hapticwall::draw
