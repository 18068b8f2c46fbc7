// `compare`: order and marks of the rows, and the figure.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "app/command/compare/compare_order.h"
#include "app/command/report/summary_fields.h"
#include "app/command/report/summary_table.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/simulate.h"
#include "tests/app/command/binary.h"

namespace hapticwall::command::test {
namespace {

Summary settled(const std::string& name, std::optional<double> stiffness_n_per_m) {
  Summary summary;
  summary.algorithm = name;
  summary.tail_peak_to_peak_m = 1e-5;
  summary.tail_force_std_n = 0.1;
  summary.displayed_stiffness_n_per_m = stiffness_n_per_m;
  summary.max_penetration_m = 1e-3;
  summary.passivity_margin_j = -1e-3;
  return summary;
}

Summary oscillating(const std::string& name, double tail_peak_to_peak_m) {
  Summary summary = settled(name, 5e4);
  summary.verdict = Verdict::kOscillating;
  summary.tail_peak_to_peak_m = tail_peak_to_peak_m;
  return summary;
}

Summary diverged(const std::string& name) {
  Summary summary;
  summary.algorithm = name;
  summary.verdict = Verdict::kDiverged;
  summary.diverged_at_tick = 7;
  return summary;
}

// Each summary as a run of one axis.
std::vector<RunSummary> one_axis(const std::vector<Summary>& summaries) {
  std::vector<RunSummary> runs;
  for (const Summary& summary : summaries) runs.push_back({summary});
  return runs;
}

std::string names(const std::vector<RunSummary>& runs, const std::string& sort) {
  const Result<RowOrder> order = parse_order(sort);
  EXPECT_TRUE(order) << order.error().message;
  std::string text;
  for (const std::size_t i : ordered(runs, *order)) text += runs[i].front().algorithm + " ";
  return text;
}

std::vector<RunSummary> seven() {
  return one_axis({diverged("d"), oscillating("o2", 2e-3), settled("soft", 1e3),
                   settled("hard", 3e4), settled("free", {}), oscillating("o1", 1e-3),
                   settled("hard2", 3e4)});
}

TEST(CompareOrder, TheUsualOneIsByVerdictThenByWhatTellsThemApart) {
  EXPECT_EQ(names(seven(), ""), "hard hard2 soft free o1 o2 d ");
}

TEST(CompareOrder, NoneKeepsTheList) {
  EXPECT_EQ(names(seven(), "none"), "d o2 soft hard free o1 hard2 ");
}

TEST(CompareOrder, ByAKeyEitherWayWithWhatHasNoneLast) {
  EXPECT_EQ(names(seven(), "displayed_stiffness_n_per_m"), "soft hard hard2 o2 o1 d free ");
  EXPECT_EQ(names(seven(), "-displayed_stiffness_n_per_m"), "o2 o1 hard hard2 soft d free ");
  EXPECT_EQ(names(seven(), "diverged_at_tick"), "d o2 soft hard free o1 hard2 ");
}

TEST(CompareOrder, VerdictsFromGoodToBadAndNamesAsTheyAreSpelt) {
  EXPECT_EQ(names(seven(), "verdict"), "soft hard free hard2 o2 o1 d ");
  EXPECT_EQ(names(seven(), "-verdict"), "d o2 o1 soft hard free hard2 ");
  EXPECT_EQ(names(seven(), "algorithm"), "d free hard hard2 o1 o2 soft ");
}

TEST(CompareOrder, ACornerIsAsGoodAsItsWorseAxis) {
  const RunSummary corner{settled("stiff", 3e4), oscillating("stiff", 1e-3)};
  const RunSummary quiet{settled("quiet", 1e3), settled("quiet", 1e3)};
  EXPECT_EQ(names({corner, quiet}, ""), "quiet stiff ");
  EXPECT_EQ(names({quiet, corner}, "-y_displayed_stiffness_n_per_m"), "stiff quiet ");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The columns of a row whose value has the mark, by their place: 0 is the algorithm.
std::string marked(const std::vector<RunSummary>& runs, std::size_t row) {
  std::istringstream cells(lines_of(comparison_table(runs)).at(row + 2));
  std::string columns;
  std::string cell;
  for (int i = 0; cells >> cell; ++i) {
    if (cell.ends_with('*')) columns += std::to_string(i) + " ";
  }
  return columns;
}

// Columns: 2 tail p-p, 4 std, 5 stiffness, 6 max pen., 10 margin.
TEST(CompareMarks, TheBestOfEachColumn) {
  Summary a = settled("a", 3e4);
  Summary b = settled("b", 1e3);
  b.tail_peak_to_peak_m = 1e-6;
  b.tail_force_std_n = 0.05;
  a.max_penetration_m = 5e-4;
  a.passivity_margin_j = -5e-4;
  EXPECT_EQ(marked(one_axis({a, b}), 0), "5 6 10 ");
  EXPECT_EQ(marked(one_axis({a, b}), 1), "2 4 ");
}

TEST(CompareMarks, AWallThatShakesIsNeitherStiffNorHardToPushInto) {
  Summary shaking = oscillating("shaking", 1e-3);
  shaking.tail_force_std_n = 0.0;
  shaking.max_penetration_m = 0.0;
  shaking.passivity_margin_j = 0.0;
  EXPECT_EQ(marked(one_axis({shaking, settled("quiet", 1e3)}), 0), "10 ");
  EXPECT_EQ(marked(one_axis({shaking, settled("quiet", 1e3)}), 1), "2 4 5 6 ");
  EXPECT_EQ(marked(one_axis({shaking, oscillating("more", 2e-3)}), 0), "2 10 ");
}

TEST(CompareMarks, ADivergedRunWinsNothing) {
  Summary lost = diverged("lost");
  lost.tail_peak_to_peak_m = 0.0;
  lost.passivity_margin_j = 0.0;
  EXPECT_EQ(marked(one_axis({lost, oscillating("shaking", 1e-3)}), 0), "");
  EXPECT_EQ(marked(one_axis({lost, oscillating("shaking", 1e-3)}), 1), "2 10 ");
  EXPECT_THAT(comparison_table(one_axis({lost, lost})), Not(HasSubstr("*")));
}

TEST(CompareMarks, TiesAreTiesBeforeRounding) {
  Summary a = settled("a", 1e3);
  Summary b = settled("b", 1e3);
  b.max_penetration_m = *a.max_penetration_m * (1.0 + 1e-15);
  EXPECT_EQ(marked(one_axis({a, b}), 0), "2 4 5 6 10 ");
  EXPECT_EQ(marked(one_axis({a, b}), 1), "2 4 5 10 ");
}

TEST(CompareMarks, AFigureThatIsNoNumberWinsNothing) {
  Summary odd = settled("odd", {});
  odd.passivity_margin_j = std::numeric_limits<double>::quiet_NaN();
  odd.max_penetration_m = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(marked(one_axis({odd, settled("even", 1e3)}), 0), "2 4 ");
  EXPECT_EQ(marked(one_axis({odd, settled("even", 1e3)}), 1), "2 4 5 6 10 ");
}

TEST(CompareMarks, OneAloneIsNotTheBest) {
  const std::string table = comparison_table(one_axis({settled("a", 1e3)}));
  EXPECT_THAT(table, Not(HasSubstr("*")));
  EXPECT_EQ(lines_of(table).size(), 3U);
}

TEST(CompareMarks, AxesAreComparedAmongThemselves) {
  RunSummary a{settled("a", 1e3), settled("a", 9e3)};
  RunSummary b{settled("b", 2e3), settled("b", 8e3)};
  b.back().verdict = Verdict::kOscillating;
  const std::vector<std::string> lines = lines_of(comparison_table({a, b}));
  EXPECT_THAT(lines.at(2), StartsWith("a "));
  EXPECT_THAT(lines.at(3), StartsWith("  axis y"));
  EXPECT_THAT(lines.at(2), HasSubstr(" 1.00  "));
  EXPECT_THAT(lines.at(2), Not(HasSubstr(" 1.00* ")));
  EXPECT_THAT(lines.at(3), HasSubstr(" 9.00* "));
  EXPECT_THAT(lines.at(4), HasSubstr(" 2.00* "));
  // A run that one axis ended has no result for the other.
  a.back().verdict = Verdict::kDiverged;
  EXPECT_EQ(marked({a, b}, 0), "");
}

TEST(CompareMarks, TheyMoveNoDigit) {
  const auto runs = one_axis({settled("a", 3e4), settled("b", 1e3)});
  const std::vector<std::string> lines = lines_of(comparison_table(runs));
  EXPECT_EQ(lines.at(2).find("30.00*") + 1, lines.at(3).find("1.00 "));
  EXPECT_EQ(lines.at(0).find("stiffness") + 9, lines.at(2).find("30.00*") + 5);
  EXPECT_THAT(lines.at(4), StartsWith("* best of its column"));
}

std::vector<std::size_t> all_algorithms() {
  std::vector<std::size_t> indices(algorithms().size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

class Compare : public ProgramTest {
 protected:
  // The first words of the table's rows.
  [[nodiscard]] static std::vector<std::string> rows(const Answer& answer, std::size_t count) {
    std::vector<std::string> names;
    const std::vector<std::string> lines = lines_of(answer.out);
    for (std::size_t i = 2; i < lines.size() && i < count + 2; ++i) {
      names.push_back(lines[i].substr(0, lines[i].find(' ')));
    }
    return names;
  }
};

TEST_F(Compare, SortsWhatPeopleReadAndNothingElse) {
  const std::string given = "none,virtual-coupling,energy-bounding";
  const Answer usual =
      hapticwall({"compare", "press", "--algorithms", given, "--csv", "a.csv", "--json", "a.json"});
  EXPECT_EQ(usual.status, 0) << usual.err;
  EXPECT_THAT(rows(usual, 3), ElementsAre("energy-bounding", "virtual-coupling", "none"));
  const auto json = nlohmann::json::parse(content("a.json"));
  EXPECT_EQ(json.at(0).at("algorithm"), "none");
  EXPECT_EQ(json.at(2).at("algorithm"), "energy-bounding");
  EXPECT_THAT(lines_of(content("a.csv")).at(1), StartsWith("press,none,"));

  const Answer kept = hapticwall({"compare", "press", "--algorithms", given, "--sort", "none"});
  EXPECT_THAT(rows(kept, 3), ElementsAre("none", "virtual-coupling", "energy-bounding"));
  for (const std::vector<std::string>& sort :
       {std::vector<std::string>{"--sort", "-max_penetration_m"}, {"--sort=-max_penetration_m"}}) {
    std::vector<std::string> arguments{"compare", "press", "--algorithms", given};
    arguments.insert(arguments.end(), sort.begin(), sort.end());
    EXPECT_THAT(rows(hapticwall(arguments), 3),
                ElementsAre("virtual-coupling", "none", "energy-bounding"));
  }
}

TEST_F(Compare, ShowsTheFormsOfAnAlgorithmInRowsOfTheirOwn) {
  const auto labels = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "compare", "press", "--duration", "0.1", "--algorithms", "passivity-control,none",
        "--json",  "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<std::string> found;
    for (const auto& row : nlohmann::json::parse(hapticwall(arguments).out)) {
      found.push_back(row.at("algorithm"));
    }
    return found;
  };
  EXPECT_THAT(labels({}), ElementsAre("passivity-control", "passivity-control (held-force)",
                                      "passivity-control (one-step)", "none"));
  EXPECT_THAT(labels({"--set", "algorithm.observer=held-force"}),
              ElementsAre("passivity-control (held-force)", "none"));
  EXPECT_THAT(labels({"--set", "algorithm.observer=same-sample"}),
              ElementsAre("passivity-control", "none"));
}

// The golden tests compare simulate() with an independent model.
TEST_F(Compare, EveryRowIsTheSummaryOfSimulate) {
  const auto without_times = [](nlohmann::json row) {
    for (const char* key : {"simulated_seconds_per_second", "ns_per_tick"}) row.erase(key);
    return row;
  };
  for (const std::string name : {"press", "tap", "tap-slow", "light"}) {
    const Answer answer = hapticwall({"compare", name, "--json", "-"});
    ASSERT_EQ(answer.status, 0) << answer.err;
    const auto rows = nlohmann::json::parse(answer.out);
    Scene scene = file::load_scene(name)->scene;
    const auto compared = compared_algorithms(scene.algorithm, all_algorithms());
    ASSERT_EQ(rows.size(), compared.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      scene.algorithm = compared[i].settings;
      RunSummary summary{simulate(scene).summary};
      summary.front().algorithm = compared[i].label;
      EXPECT_EQ(without_times(rows[i]),
                without_times(nlohmann::json::parse(summary_json(summary))));
    }
  }
}

// The column has the numbers of `worst-hand`, and is there on demand only.
TEST_F(Compare, AddsASearchForAHandOnDemand) {
  const std::vector<std::string> scene{"tap", "--duration", "1", "--algorithms",
                                       "none,force-bounding"};
  const auto answer = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), scene.begin(), scene.end());
    words.insert(words.end(), more.begin(), more.end());
    const Answer given = hapticwall(words);
    EXPECT_EQ(given.status, 0) << given.err;
    return given.out;
  };
  const std::string table = answer({"compare"}, {"--worst-hand", "60", "--csv", "a.csv"});
  EXPECT_THAT(table, AllOf(HasSubstr("  60 hands"), HasSubstr("  J typical"),
                           HasSubstr("\n60 hands: median energy"), HasSubstr("wide bounds")));
  EXPECT_THAT(content("a.csv"), HasSubstr(",searched_hands,most_taken_j,typical_taken_j\n"));
  const std::string found = answer({"worst-hand"}, {"--hands", "60", "--json", "-"});
  const auto rows = nlohmann::json::parse(found).at("rows");
  const std::string compared = answer({"compare"}, {"--worst-hand", "60", "--json", "-"});
  const auto runs = nlohmann::json::parse(compared);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(runs.at(i).at("searched_hands"), 60);
    EXPECT_EQ(runs.at(i).at("most_taken_j"), rows.at(i).at("most_j"));
    EXPECT_EQ(runs.at(i).at("typical_taken_j"), rows.at(i).at("typical_j"));
  }
  EXPECT_TRUE(runs.at(0).at("typical_taken_j").is_number());
  EXPECT_TRUE(runs.at(1).at("typical_taken_j").is_null());
  const std::string without = answer({"compare"}, {"--json", "-"});
  EXPECT_THAT(without, Not(HasSubstr("taken_j")));
}

TEST_F(Compare, PlotWritesAPictureThatFollowsTheOrder) {
  const std::vector<std::string> common{"compare", "press",        "--duration",
                                        "2",       "--algorithms", "none,energy-bounding"};
  const auto plot = [&](const std::string& name, const std::string& sort) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--sort", sort, "--plot", name});
    const Answer answer = hapticwall(arguments);
    EXPECT_EQ(answer.status, 0) << answer.err;
    EXPECT_THAT(answer.out, HasSubstr("energy-bounding  "));
  };
  plot("a.png", "none");
  plot("b.png", "none");
  plot("c.png", "-algorithm");
  plot("d.png", "algorithm");
  EXPECT_THAT(content("a.png"), StartsWith("\x89PNG\r\n"));
  EXPECT_TRUE(content("a.png") == content("b.png"));
  EXPECT_TRUE(content("a.png") == content("c.png"));
  EXPECT_FALSE(content("a.png") == content("d.png"));
  EXPECT_THAT(files(), ElementsAre("a.png", "b.png", "c.png", "d.png"));
}

}  // namespace
}  // namespace hapticwall::command::test
