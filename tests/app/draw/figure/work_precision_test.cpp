#include <gtest/gtest.h>

#include "app/draw/figure/log_figure.h"
#include "app/draw/plot/theme.h"
#include "app/study/accuracy/accuracy.h"
#include "tests/app/draw/figure/vector_files.h"
#include "tests/app/ui/pixels.h"

namespace hapticwall::study::accuracy {
namespace {

constexpr int kHeading = 160;  // title and legend, pixels
constexpr int kWidth = 2102;
constexpr int kHeight = 880;  // less than the page

using draw::Ink;
using draw::Look;
using draw::theme_colours;
using draw::Tone;

AccuracyRow made_up_row(Integrator integrator, std::optional<int> substeps, double cost_ns,
                        double error) {
  AccuracyRow row;
  row.integrator = integrator;
  row.substeps = substeps;
  row.ns_per_tick = cost_ns;
  row.max_position_error_m = 1e-3 * error;
  row.tail_peak_to_peak_m = 1e-3;
  row.tail_peak_to_peak_relative_error = -error;
  row.verdict = Verdict::kOscillating;
  row.verdict_agrees = true;
  return row;
}

AccuracyStudy made_up_study() {
  AccuracyStudy study;
  study.reference.scene = "golden-hard";
  study.reference.algorithm = "none";
  study.reference.verdict = Verdict::kOscillating;
  study.reference.tail_peak_to_peak_m = 1e-3;
  study.rows = {made_up_row(Integrator::kExact, std::nullopt, 7.0, 1e-12),
                made_up_row(Integrator::kSemiImplicitEuler, 1, 10.0, 1.0),
                made_up_row(Integrator::kSemiImplicitEuler, 10, 100.0, 0.1),
                made_up_row(Integrator::kRungeKutta4, 1, 40.0, 1e-4),
                made_up_row(Integrator::kRungeKutta4, 10, 400.0, 1e-8)};
  return study;
}

file::Picture drawn(const AccuracyStudy& study) {
  const Result<file::Picture> figure = draw::draw_log_page(work_precision(study));
  EXPECT_TRUE(figure.ok()) << (figure.ok() ? "" : figure.error().message);
  return figure.ok() ? *figure : file::Picture{};
}

int count(const file::Picture& figure, Tone tone, int from_x, int to_x) {
  const ImVec4 colour = theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)];
  return test::count_pixels(figure, test::colour_of(colour), from_x, kHeading, to_x, kHeight);
}

TEST(WorkPrecision, BothPlotsHaveAllThreeIntegrators) {
  const file::Picture figure = drawn(made_up_study());
  ASSERT_EQ(figure.width, kWidth);
  ASSERT_GE(figure.height, kHeight);
  constexpr int kEnoughPixels = 100;  // a marker and some line
  for (const int left : {0, kWidth / 2}) {
    EXPECT_GT(count(figure, Tone::kForce, left, left + kWidth / 2), kEnoughPixels) << left;
    EXPECT_GT(count(figure, Tone::kPosition, left, left + kWidth / 2), kEnoughPixels) << left;
    EXPECT_GT(count(figure, Tone::kGood, left, left + kWidth / 2), kEnoughPixels) << left;
  }
}

TEST(WorkPrecision, AWrongVerdictIsAHollowMark) {
  AccuracyStudy study = made_up_study();
  const int filled = count(drawn(study), Tone::kForce, 0, kWidth);
  study.rows[1].verdict_agrees = false;
  const int hollow = count(drawn(study), Tone::kForce, 0, kWidth);
  // Two discs have lost their inside.
  EXPECT_LT(hollow, filled - 60);
  EXPECT_GT(hollow, filled / 2);
}

// Dearer is further right, more accurate is further down.
TEST(WorkPrecision, PutsPointsWhereTheyBelong) {
  AccuracyStudy study = made_up_study();
  study.rows.resize(1);
  study.rows.push_back(made_up_row(Integrator::kSemiImplicitEuler, 1, 700.0, 1e-2));
  const file::Picture figure = drawn(study);
  struct Mean {
    double x = 0.0;
    double y = 0.0;
  };
  const auto mean = [&](Tone tone) {
    const test::Colour wanted =
        test::colour_of(theme_colours(Look::kPrint)[static_cast<std::size_t>(tone)]);
    Mean sum;
    int pixels = 0;
    for (int y = kHeading; y < kHeight; ++y) {
      for (int x = 0; x < kWidth / 2; ++x) {
        if (test::difference(test::pixel(figure, x, y), wanted) > 24) continue;
        sum = {sum.x + x, sum.y + y};
        ++pixels;
      }
    }
    return Mean{sum.x / pixels, sum.y / pixels};
  };
  const Mean exact = mean(Tone::kGood);
  const Mean euler = mean(Tone::kForce);
  EXPECT_LT(exact.x + kWidth / 4.0, euler.x);
  EXPECT_GT(exact.y, euler.y + kHeight / 2.0);
}

TEST(WorkPrecision, RunsThatDivergedAreNamedAndNotDrawn) {
  AccuracyStudy study = made_up_study();
  for (const std::size_t i : {1U, 2U}) {
    study.rows[i].max_position_error_m.reset();
    study.rows[i].tail_peak_to_peak_relative_error.reset();
  }
  // Nothing but the names tells these three pages apart.
  const file::Picture none_named = drawn(study);
  study.rows[1].verdict = Verdict::kDiverged;
  const file::Picture one_named = drawn(study);
  study.rows[2].verdict = Verdict::kDiverged;
  const file::Picture two_named = drawn(study);
  EXPECT_NE(none_named.rgba, one_named.rgba);
  EXPECT_NE(one_named.rgba, two_named.rgba);
  EXPECT_EQ(count(two_named, Tone::kForce, 0, kWidth), 0);
  EXPECT_GT(count(two_named, Tone::kPosition, 0, kWidth), 0);
}

TEST(WorkPrecision, AnErrorOfZeroIsShownAtTheFoot) {
  AccuracyStudy study = made_up_study();
  study.rows[0].max_position_error_m = 0.0;
  study.rows[0].tail_peak_to_peak_relative_error = 0.0;
  EXPECT_GT(count(drawn(study), Tone::kGood, 0, kWidth / 2), 50);
}

TEST(WorkPrecision, AStudyWithoutErrorsIsStillAPage) {
  AccuracyStudy study = made_up_study();
  for (AccuracyRow& row : study.rows) {
    row.max_position_error_m.reset();
    row.tail_peak_to_peak_relative_error.reset();
  }
  const file::Picture figure = drawn(study);
  EXPECT_EQ(count(figure, Tone::kForce, 0, kWidth), 0);
  EXPECT_GT(test::count_pixels(figure, {255, 255, 255}, 0, 0, kWidth, kHeight),
            kWidth * kHeight / 2);
}

TEST(WorkPrecision, IsTheSameEveryTime) {
  EXPECT_EQ(drawn(made_up_study()).rgba, drawn(made_up_study()).rgba);
}

TEST(WorkPrecision, IsTheSameInVectorFiles) {
  test::expect_same_in_vector_files(
      [](Ink ink) { return draw::draw_log_page(work_precision(made_up_study()), {.ink = ink}); });
}

}  // namespace
}  // namespace hapticwall::study::accuracy
