#include "app/draw/plot/derived_signals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "app/draw/plot/spectrum.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "tests/samples.h"

namespace hapticwall::draw {
namespace {

using ::testing::HasSubstr;

constexpr double kTickHz = 1000.0;
constexpr DerivedSignal kHandleBesideTruth{DerivedKind::kDifference, &Sample::position_m,
                                           &PlantTruth::position_m, 0.0};
constexpr DerivedSignal kForceMean{DerivedKind::kMean, &Sample::force_n, &Sample::force_n, 0.05};
constexpr std::size_t kForceMeanTicks = 50;
constexpr DerivedSignal kHandleRate{DerivedKind::kDerivative, &Sample::position_m,
                                    &Sample::position_m, 0.0};
constexpr DerivedSignal kStiffnessMean{DerivedKind::kMean, Derived::kStiffness, Derived::kStiffness,
                                       0.01};
constexpr DerivedSignals kFour{kHandleBesideTruth, kForceMean, kHandleRate, kStiffnessMean};

constexpr Quantity at(std::size_t place) { return Quantity::derived_signal(place); }

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// The samples of a signal from those of a run, by the formulas of docs/window.md.
std::vector<double> differences(const std::vector<Sample>& samples) {
  std::vector<double> values;
  for (const Sample& sample : samples)
    values.push_back(sample.position_m - sample.truth.position_m);
  return values;
}
std::vector<double> means(const std::vector<Sample>& samples) {
  std::vector<double> values;
  double sum = 0.0;
  std::size_t ticks = 0;  // without a gap
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == 0 || samples[i - 1].tick + 1 != samples[i].tick) ticks = 0, sum = 0.0;
    sum += samples[i].force_n;
    if (++ticks > kForceMeanTicks) sum -= samples[i - kForceMeanTicks].force_n;
    values.push_back(ticks >= kForceMeanTicks ? sum / kForceMeanTicks : kMasked);
  }
  return values;
}
std::vector<double> rates(const std::vector<Sample>& samples) {
  std::vector<double> values;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool next = i > 0 && samples[i - 1].tick + 1 == samples[i].tick;
    values.push_back(next ? (samples[i].position_m - samples[i - 1].position_m) * kTickHz
                          : kMasked);
  }
  return values;
}

// A bare wall that chatters: no signal rests.
std::vector<Sample> chatter() {
  Scene scene = file::load_scene("press")->scene;
  scene.algorithm.index = *find_algorithm("none");
  return testing::samples_of(scene);
}

SampleHistory history_of(const std::vector<Sample>& samples, const DerivedSignals& derived = kFour,
                         std::size_t capacity = 1'000'000) {
  SampleHistory history(capacity, 1e-5);
  history.derive(derived, kTickHz);
  history.push(samples);
  return history;
}

// Of the samples [first, last) that are not masked.
struct Figures {
  double count = 0.0;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  Extremes extremes{HUGE_VAL, -HUGE_VAL};
};
Figures figures_of(const std::vector<double>& values, std::size_t first, std::size_t last) {
  Figures figures;
  for (std::size_t i = first; i < last; ++i) {
    if (std::isnan(values[i])) continue;
    ++figures.count;
    figures.sum += values[i];
    figures.sum_of_squares += values[i] * values[i];
    figures.extremes.include({values[i], values[i]});
  }
  return figures;
}

void expect_stats(const SampleStats& stats, const Figures& wanted, double tolerance) {
  ASSERT_EQ(stats.count, wanted.count);
  if (stats.empty()) return;
  ASSERT_NEAR(stats.extremes.minimum, wanted.extremes.minimum, tolerance);
  ASSERT_NEAR(stats.extremes.maximum, wanted.extremes.maximum, tolerance);
  ASSERT_NEAR(stats.mean(), wanted.sum / wanted.count, tolerance);
}

// Every sample from `from` on.
void expect_values(const SampleHistory& history, std::size_t place,
                   const std::vector<double>& wanted, double tolerance, std::size_t from = 0) {
  for (std::size_t i = from; i < wanted.size(); ++i) {
    const double value = history.value(at(place), i);
    ASSERT_TRUE(same(value, wanted[i]) || std::abs(value - wanted[i]) <= tolerance)
        << place << " at " << i << ": " << value << ", not " << wanted[i];
  }
}

// Ranges of every length.
void expect_ranges(const SampleHistory& history, std::size_t place,
                   const std::vector<double>& wanted, double tolerance, std::size_t from = 0) {
  std::mt19937_64 random(11);
  for (std::size_t length = wanted.size() - from; length > 0; length = length * 4 / 5) {
    const std::size_t first = from + random() % (wanted.size() - from - length + 1);
    const IndexRange range{first, first + length};
    const Figures figures = figures_of(wanted, range.first, range.last);
    expect_stats(history.stats(at(place), range), figures, tolerance);
    if (figures.count == 0.0) continue;
    const double mean = figures.sum / figures.count;
    const double variance = figures.sum_of_squares / figures.count - mean * mean;
    ASSERT_NEAR(history.variance(at(place), range), variance,
                1e-9 * figures.sum_of_squares / figures.count + tolerance);
  }
}

// The groups of samples that are drawn as one, over the newest shares of the history.
void expect_groups(const SampleHistory& history, std::size_t place,
                   const std::vector<double>& wanted, double tolerance) {
  for (const std::size_t share : {1U, 9U, 600U}) {
    const IndexRange range{wanted.size() - wanted.size() / share, wanted.size()};
    const std::size_t columns = 480;
    const std::size_t group = decimation_group(range.count(), columns);
    std::size_t first = range.first;
    history.for_each_group(at(place), range, columns, [&](const SampleGroup& found) {
      const std::size_t whole = std::min((first / group + 1) * group, range.last);
      const std::size_t last = whole - first <= 2 ? first + 1 : whole;
      expect_stats(found.stats, figures_of(wanted, first, last), tolerance);
      first = last;
    });
    EXPECT_EQ(first, range.last);
  }
}

TEST(DerivedSignals, AreWhatTheirFormulasGiveOfTheSamples) {
  const std::vector<Sample> samples = chatter();
  const SampleHistory history = history_of(samples);
  ASSERT_GT(history.size(), 3000U);
  const std::array wanted{differences(samples), means(samples), rates(samples)};
  const std::array tolerances{0.0, 1e-12, 1e-12};
  for (std::size_t place = 0; place < wanted.size(); ++place) {
    expect_values(history, place, wanted[place], tolerances[place]);
    expect_ranges(history, place, wanted[place], 1e-12);
    expect_groups(history, place, wanted[place], 1e-12);
  }
  // The loop's own backward difference.
  for (std::size_t i = 1; i < samples.size(); ++i)
    ASSERT_NEAR(history.value(at(2), i), samples[i].velocity_m_per_s, 1e-9);
}

// An hour at 1 kHz, of which a piece is already forgotten, and the signals are chosen at its end.
TEST(DerivedSignals, OfAnHourAreRightAtEveryZoom) {
  constexpr std::uint64_t kCount = 3'610'000;
  std::mt19937_64 random(5);
  SampleHistory history(kHistoryCapacity);
  std::vector<Sample> samples;
  for (std::uint64_t tick = 0; tick < kCount; ++tick) {
    Sample sample;
    sample.tick = tick;
    sample.time_s = static_cast<double>(tick) / kTickHz;
    sample.position_m = 1e-6 * static_cast<double>(random() % 1000);
    sample.force_n = random() % 5000 == 0 ? 300.0 : static_cast<double>(random() % 7);
    samples.push_back(sample);
    history.push(sample);
  }
  history.derive({kHandleBesideTruth, kForceMean, kHandleRate}, kTickHz);
  samples.erase(samples.begin(), samples.end() - static_cast<std::ptrdiff_t>(history.size()));
  ASSERT_LT(samples.size(), kCount);
  expect_ranges(history, 0, differences(samples), 1e-12);
  expect_ranges(history, 1, means(samples), 1e-10);
  expect_ranges(history, 2, rates(samples), 1e-10);
}

TEST(DerivedSignals, ChosenBeforeOrAfterTheSamplesAreTheSame) {
  const std::vector<Sample> samples = chatter();
  const SampleHistory before = history_of(samples);
  SampleHistory after = history_of(samples, {});
  after.derive(kFour, kTickHz);
  EXPECT_EQ(after.derived(), kFour);
  for (std::size_t place = 0; place < kFour.size(); ++place) {
    for (const IndexRange range : {IndexRange{0, samples.size()}, IndexRange{77, 2900}}) {
      const SampleStats a = before.stats(at(place), range);
      const SampleStats b = after.stats(at(place), range);
      EXPECT_EQ(a.extremes.minimum, b.extremes.minimum);
      EXPECT_EQ(a.extremes.maximum, b.extremes.maximum);
      EXPECT_EQ(a.sum, b.sum);
      EXPECT_EQ(a.count, b.count);
    }
  }
}

TEST(DerivedSignals, StayRightWhileTheOldestSamplesAreForgotten) {
  std::vector<Sample> samples;
  for (int round = 0; round < 5; ++round) {
    for (Sample sample : chatter()) {
      sample.tick = samples.size();
      sample.time_s = static_cast<double>(sample.tick) / kTickHz;
      samples.push_back(sample);
    }
  }
  const SampleHistory history = history_of(samples, kFour, 5000);
  samples.erase(samples.begin(), samples.end() - static_cast<std::ptrdiff_t>(history.size()));
  ASSERT_LT(samples.size(), 6100U);
  // Blocks of the oldest samples still know those before them.
  expect_values(history, 1, means(samples), 1e-12);
  expect_ranges(history, 1, means(samples), 1e-12, kForceMeanTicks);
  expect_ranges(history, 2, rates(samples), 1e-12, 1);
  SampleHistory copy = history;
  copy.push(Sample{});
  EXPECT_EQ(copy.size(), 1U);
  EXPECT_TRUE(copy.stats(at(2), {0, 1}).empty()) << "a reset is the beginning";
  EXPECT_EQ(copy.stats(at(0), {0, 1}).count, 1.0);
}

TEST(DerivedSignals, ReachOverNoGap) {
  std::vector<Sample> samples = chatter();
  for (const std::size_t dropped : {2500U, 1200U, 1199U, 300U})
    samples.erase(samples.begin() + static_cast<std::ptrdiff_t>(dropped));
  const SampleHistory history = history_of(samples);
  EXPECT_TRUE(std::isnan(history.value(at(2), 0))) << "nothing is before the first sample";
  EXPECT_TRUE(std::isnan(history.value(at(2), 300)));
  EXPECT_FALSE(std::isnan(history.value(at(2), 301)));
  EXPECT_TRUE(std::isnan(history.value(at(1), 300 + kForceMeanTicks - 2)));
  EXPECT_FALSE(std::isnan(history.value(at(1), 300 + kForceMeanTicks - 1)));
  EXPECT_FALSE(std::isnan(history.value(at(0), 300))) << "a difference has no past";
  expect_values(history, 1, means(samples), 1e-12);
  expect_values(history, 2, rates(samples), 1e-12);
  expect_ranges(history, 1, means(samples), 1e-12);
  expect_ranges(history, 2, rates(samples), 1e-12);
}

TEST(DerivedSignals, OfAMaskedSampleAreMasked) {
  const std::vector<Sample> samples = chatter();
  const SampleHistory history = history_of(samples);
  std::size_t known = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    double sum = 0.0;  // NaN of a masked one
    for (std::size_t back = 0; back < 10; ++back)
      sum += i >= back ? history.value(Derived::kStiffness, i - back) : kMasked;
    const double mean = history.value(at(3), i);
    ASSERT_EQ(std::isnan(mean), std::isnan(sum)) << i;
    if (std::isnan(sum)) continue;
    ASSERT_NEAR(mean, sum / 10.0, 1e-9 * std::abs(sum));
    ++known;
  }
  EXPECT_GT(known, 1000U);
  EXPECT_LT(known, history.size() - 20);
}

TEST(DerivedSignals, AnotherRateIsAnotherDerivativeAndAnotherMean) {
  const std::vector<Sample> samples = chatter();
  SampleHistory history = history_of(samples);
  const double slow = history.value(at(2), 1234);
  const double all = history.stats(at(2), {0, samples.size()}).extremes.maximum;
  history.derive(kFour, 2.0 * kTickHz);
  EXPECT_DOUBLE_EQ(history.value(at(2), 1234), 2.0 * slow);
  EXPECT_DOUBLE_EQ(history.stats(at(2), {0, samples.size()}).extremes.maximum, 2.0 * all);
  EXPECT_TRUE(std::isnan(history.value(at(1), 2 * kForceMeanTicks - 2)));
  EXPECT_FALSE(std::isnan(history.value(at(1), 2 * kForceMeanTicks - 1)));
}

// The derivative of A sin(2π f t) has the amplitude of a backward difference: 2 A sin(π f T) / T.
TEST(DerivedSignals, HaveASpectrum) {
  constexpr double kSineHz = 49.8;
  std::vector<Sample> samples(6000);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].tick = i;
    samples[i].time_s = static_cast<double>(i) / kTickHz;
    samples[i].position_m = 1e-3 * std::sin(2.0 * M_PI * kSineHz * samples[i].time_s);
  }
  const SampleHistory history = history_of(samples);
  const auto line = strongest_line(spectrum_of(history, at(2), {0, samples.size()}));
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->frequency_hz, kSineHz, 0.02);
  const double amplitude = 2.0 * 1e-3 * std::sin(M_PI * kSineHz / kTickHz) * kTickHz;
  EXPECT_NEAR(line->amplitude, amplitude, 0.02 * amplitude);
}

// ---- their lines

TEST(DerivedSignals, AreDrawnInThePlotThatHasTheirUnit) {
  const auto unit_of = [](DerivedKind kind, Quantity quantity) {
    const PlotTable table({DerivedSignal{kind, quantity, quantity, 0.1}});
    const auto found = table.find(at(0));
    EXPECT_TRUE(found.has_value());
    EXPECT_EQ(found->plot->id, usual_plots().find(quantity)->plot->id);
    return std::string(found->scale().unit);
  };
  using enum DerivedKind;
  EXPECT_EQ(unit_of(kMean, &Sample::position_m), "mm");
  EXPECT_EQ(unit_of(kDerivative, &Sample::position_m), "mm/s");
  EXPECT_EQ(unit_of(kMean, &Sample::velocity_m_per_s), "mm/s");
  EXPECT_EQ(unit_of(kDerivative, &Sample::velocity_m_per_s), "m/s²");
  EXPECT_EQ(unit_of(kDerivative, &Sample::force_n), "N/s");
  EXPECT_EQ(unit_of(kDerivative, Derived::kStiffness), "kN/m/s");
  EXPECT_EQ(unit_of(kDerivative, &Sample::energy_hold_j), "mW");
}

// A unit's scale is that of its plot by the second: 1 mm/s is 1 mm in a second.
TEST(DerivedSignals, EveryLineHasADerivativeWithAScale) {
  for (const PlotId id : kAllPlots) {
    for (const PlotLine& line : plot_description(id).lines) {
      const PlotTable table(
          {DerivedSignal{DerivedKind::kDerivative, line.quantity, line.quantity}});
      EXPECT_GT(table.find(at(0))->scale().scale, 0.0) << line.name;
      EXPECT_EQ(table.find(at(0))->line->is_truth(), line.is_truth()) << line.name;
    }
  }
}

TEST(DerivedSignals, TheirNamesAreReadBack) {
  EXPECT_EQ(derived_name(kHandleRate), "derivative(handle)");
  EXPECT_EQ(derived_name(kForceMean), "mean(actuator F_d over 0.05 s)");
  EXPECT_EQ(derived_name(kHandleBesideTruth), "difference(handle - true position)");
  for (const PlotId id : kAllPlots) {
    for (const PlotLine& a : plot_description(id).lines) {
      for (const PlotLine& b : plot_description(id).lines) {
        const double over_s = 0.1 * static_cast<double>(1 + b.quantity.index());
        for (const DerivedKind kind :
             {DerivedKind::kDifference, DerivedKind::kMean, DerivedKind::kDerivative}) {
          const DerivedSignal signal{kind, a.quantity, b.quantity, over_s};
          if (derived_problem(signal, {})) continue;
          const auto found = derived_called(derived_name(signal));
          ASSERT_TRUE(found.has_value()) << derived_name(signal);
          EXPECT_EQ(derived_name(*found), derived_name(signal));
          EXPECT_EQ(derived_name(signal).find(','), std::string::npos) << "lists have commas";
        }
      }
    }
  }
}

TEST(DerivedSignals, NoOtherTextIsTheNameOfOne) {
  for (const char* text : {"",
                           "(",
                           "()",
                           "derivative",
                           "derivative(",
                           "derivative()",
                           "derivative(nothing)",
                           "derivative(handle",
                           "derivative(handle) ",
                           "root(handle)",
                           "mean(handle)",
                           "mean(handle over )",
                           "mean(handle over 1 h)",
                           "mean(handle over -1 s)",
                           "mean(handle over nan s)",
                           "mean(handle over 0 s)",
                           "mean(handle over 4000 s)",
                           "difference(handle)",
                           "difference(handle - handle)",
                           "difference(handle - velocity)",
                           "difference(handle - actuator F_d)",
                           "derivative(derivative(handle))"})
    EXPECT_FALSE(derived_called(text).has_value()) << text;
  EXPECT_TRUE(derived_called("mean(handle over 0.5)").has_value());
}

TEST(DerivedSignals, AProblemSaysWhatToDo) {
  const auto problem = [](DerivedKind kind, Quantity a, Quantity b, double over_s) {
    return derived_problem({kind, a, b, over_s}, {1e-3, 6.0}).value_or("");
  };
  using enum DerivedKind;
  EXPECT_EQ(problem(kDifference, &Sample::position_m, &Sample::force_n, 0.0),
            "handle is in mm, actuator F_d in N: choose two of one unit");
  EXPECT_THAT(problem(kDifference, &Sample::position_m, &Sample::velocity_m_per_s, 0.0),
              HasSubstr("in mm/s"));
  EXPECT_THAT(problem(kDifference, &Sample::force_n, &Sample::force_n, 0.0),
              HasSubstr("choose two signals"));
  EXPECT_EQ(problem(kDifference, &Sample::force_n, &Sample::wall_force_n, 0.0), "");
  for (const double over_s : {0.0, -1.0, 0.9e-3, 6.1, HUGE_VAL, std::nan("")})
    EXPECT_THAT(problem(kMean, &Sample::force_n, &Sample::force_n, over_s),
                HasSubstr("one tick (0.001 s) to the length of the time axes (6 s)"));
  for (const double over_s : {1e-3, 6.0})
    EXPECT_EQ(problem(kMean, &Sample::force_n, &Sample::force_n, over_s), "");
}

TEST(DerivedSignals, AreAddedToFreePlacesAndChosen) {
  DerivedSignals all;
  ChosenLines chosen{};
  HiddenLines hidden = 0;
  for (const auto& signal : kFour) EXPECT_TRUE(add_derived(*signal, all, chosen));
  EXPECT_EQ(all, kFour);
  EXPECT_FALSE(add_derived({}, all, chosen)) << "there is no place";
  hidden = line_bit(at(1)) | line_bit(&Sample::force_n);
  remove_derived(1, all, chosen, hidden);
  EXPECT_EQ(hidden, line_bit(&Sample::force_n));
  EXPECT_EQ(chosen[static_cast<std::size_t>(PlotId::kForce)], 0U);
  EXPECT_FALSE(add_derived(kHandleRate, all, chosen)) << "it is there";
  EXPECT_TRUE(add_derived({DerivedKind::kDerivative, &Sample::force_n}, all, chosen));
  EXPECT_EQ(chosen[static_cast<std::size_t>(PlotId::kForce)], line_bit(at(1)));
  EXPECT_EQ(all[2], kHandleRate) << "the others stay at their places";
}

}  // namespace
}  // namespace hapticwall::draw
