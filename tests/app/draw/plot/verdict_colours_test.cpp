// Verdicts are told apart by lightness alone, as in a print without colours, and are read on their
// background.
#include "app/draw/figure/verdict_colours.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "app/draw/plot/theme.h"
#include "tests/app/draw/plot/colorimetry.h"

namespace hapticwall::draw {
namespace {

// L*. A step of Munsell's scale of grey values, which the eye tells apart without a direct
// comparison, is 10. Three such steps and the text do not fit between the text and the lightest
// colour that is readable on white (46): 8 does.
constexpr double kApart = 8.0;

struct Shown {
  std::string name;
  ImVec4 colour;
};

void expect_apart(const std::vector<Shown>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance =
          std::abs(test::lightness(all[i].colour) - test::lightness(all[j].colour));
      EXPECT_GE(distance, kApart) << all[i].name << ", " << all[j].name;
    }
  }
}

// A verdict of each grade.
constexpr std::array kGrades{Verdict::kSettled, Verdict::kNoContact, Verdict::kBuzzing,
                             Verdict::kOscillating};

TEST(VerdictColours, GradesDifferInLightnessInEveryLook) {
  for (const Look look : {Look::kScreen, Look::kLight, Look::kPrint}) {
    SCOPED_TRACE(static_cast<int>(look));
    std::vector<Shown> all;
    for (const Verdict verdict : kGrades) {
      const auto tone = static_cast<std::size_t>(verdict_tone(verdict));
      all.push_back({std::string(verdict_name(verdict)), theme_colours(look)[tone]});
    }
    expect_apart(all);
  }
}

TEST(VerdictColours, WordsAreReadOnTheirBackgroundInEveryLook) {
  constexpr double kReadable = 4.5;  // WCAG 2.2, 1.4.3
  for (const Look look : {Look::kScreen, Look::kLight, Look::kPrint}) {
    for (const Verdict verdict : kGrades) {
      const auto& colours = theme_colours(look);
      const ImVec4& word = colours[static_cast<std::size_t>(verdict_tone(verdict))];
      for (const Tone ground : {Tone::kPanel, Tone::kBackground}) {
        EXPECT_GE(test::contrast(word, colours[static_cast<std::size_t>(ground)]), kReadable)
            << verdict_name(verdict) << " in look " << static_cast<int>(look);
      }
    }
  }
}

TEST(VerdictColours, AreasOfAMapDifferInLightness) {
  std::vector<Shown> all;
  for (const Verdict verdict : {Verdict::kSettled, Verdict::kNoContact, Verdict::kActive,
                                Verdict::kBuzzing, Verdict::kDiverged}) {
    all.push_back({std::string(verdict_name(verdict)),
                   ImGui::ColorConvertU32ToFloat4(verdict_area(verdict))});
  }
  expect_apart(all);
}

TEST(VerdictColours, AnOscillationIsDarkerTheFurtherItSwings) {
  double before = 101.0;
  for (const double amplitude_m : {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1}) {
    const ImVec4 colour = ImGui::ColorConvertU32ToFloat4(oscillating_colour(amplitude_m));
    EXPECT_LT(test::lightness(colour), before - 4.0) << amplitude_m;
    before = test::lightness(colour);
  }
}

}  // namespace
}  // namespace hapticwall::draw
