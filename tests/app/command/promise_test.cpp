// The promises of docs/physics.md, tested on the program: `run` against trajectories of 200 digits,
// `compare --json -` against the table of an independent model (verdicts exactly; amplitudes,
// forces and stiffnesses within 10 %).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/app/command/binary.h"
#include "tests/paths.h"

namespace hapticwall::command::test {
namespace {

using Table = std::map<std::string, std::vector<double>>;

Table read_csv(std::istream& in) {
  std::vector<std::string> names;
  std::string line;
  std::string cell;
  std::getline(in, line);
  for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  Table table;
  while (std::getline(in, line)) {
    std::istringstream row(line);
    for (const std::string& name : names) {
      std::getline(row, cell, ',');
      table[name].push_back(cell.empty() ? 0.0 : std::stod(cell));
    }
  }
  return table;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference = std::max(difference, std::abs(a[i] - b[i]));
  return difference;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

class Promise : public ProgramTest {
 protected:
  [[nodiscard]] Table recorded(const std::string& scene) const {
    const Answer answer = hapticwall({"run", scene, "--csv", "run.csv", "--quiet"});
    EXPECT_EQ(answer.status, 0) << answer.err;
    std::istringstream text(content("run.csv"));
    return read_csv(text);
  }
  static Table reference(const std::string& name) {
    std::ifstream file(hapticwall::test::data_folder() + "/golden/" + name);
    return read_csv(file);
  }
};

TEST_F(Promise, RunMeetsTheReferenceTrajectories) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"golden-soft", "soft.csv"},
      {"golden-hard", "hard.csv"},
      {"golden-soft-fric", "soft_fric.csv"}};
  for (const auto& [scene, file] : cases) {
    const Table ours = recorded(scene);
    Table golden = reference(file);
    for (auto& [name, column] : golden) column.pop_back();  // the state after the last tick's force
    ASSERT_EQ(ours.at("tick").size(), 5000U) << scene;
    ASSERT_EQ(golden.at("tick").size(), 5000U) << scene;
    EXPECT_LE(largest_difference(ours.at("true_position_m"), golden.at("position_m")), 1e-14)
        << scene;
    EXPECT_LE(largest_difference(ours.at("true_actuator_work_j"), golden.at("actuator_work_j")),
              1e-10 * largest(golden.at("actuator_work_j")))
        << scene;
    // With friction, the column includes its loss (tests/golden separates them).
    if (scene == "golden-soft-fric") continue;
    EXPECT_LE(largest_difference(ours.at("true_dissipation_j"), golden.at("viscous_dissipation_j")),
              1e-10 * largest(golden.at("viscous_dissipation_j")))
        << scene;
  }
}

struct Expected {
  std::string scene;
  std::string algorithm;
  std::string verdict;
  std::map<std::string, double> figures;
};

TEST_F(Promise, CompareGivesTheTableOfScenes) {
  const std::vector<Expected> table{
      {"press",
       "none",
       "oscillating",
       {{"tail_peak_to_peak_m", 2.8e-3}, {"tail_force_mean_n", 4.9}, {"tail_force_std_n", 4.4}}},
      {"tap", "none", "oscillating", {{"tail_peak_to_peak_m", 1.95e-3}}},
      {"tap-slow", "none", "oscillating", {{"tail_peak_to_peak_m", 1.95e-3}}},
      {"light", "none", "oscillating", {{"tail_peak_to_peak_m", 5.8e-3}}},
      {"press",
       "virtual-coupling",
       "settled",
       {{"tail_force_mean_n", 4.40}, {"displayed_stiffness_n_per_m", 1.89e3}}},
      {"tap", "virtual-coupling", "settled", {}},
      {"tap-slow", "virtual-coupling", "settled", {}},
      {"light", "virtual-coupling", "settled", {}},
      {"press",
       "energy-bounding",
       "settled",
       {{"tail_force_mean_n", 4.97},
        {"tail_force_std_n", 0.13},
        {"displayed_stiffness_n_per_m", 30e3}}},
      {"tap", "energy-bounding", "oscillating", {{"tail_peak_to_peak_m", 14e-3}}},
      {"tap-slow", "energy-bounding", "settled", {{"displayed_stiffness_n_per_m", 24e3}}},
      {"light", "energy-bounding", "oscillating", {{"tail_peak_to_peak_m", 27e-3}}},
  };
  for (const std::string scene : {"press", "tap", "tap-slow", "light"}) {
    const Answer answer = hapticwall({"compare", scene, "--json", "-"});
    ASSERT_EQ(answer.status, 0) << answer.err;
    std::map<std::string, nlohmann::json> rows;
    for (const auto& row : nlohmann::json::parse(answer.out)) rows[row.at("algorithm")] = row;
    for (const Expected& expected : table) {
      if (expected.scene != scene) continue;
      const nlohmann::json& row = rows.at(expected.algorithm);
      EXPECT_EQ(row.at("verdict"), expected.verdict) << scene << " " << expected.algorithm;
      for (const auto& [key, value] : expected.figures) {
        EXPECT_NEAR(row.at(key).get<double>(), value, 0.1 * value)
            << scene << " " << expected.algorithm << " " << key;
      }
    }
    // The same-sample observer never acts on a spring wall.
    for (const char* key :
         {"verdict", "tail_peak_to_peak_m", "tail_force_mean_n", "energy_scv_j"}) {
      EXPECT_EQ(rows.at("passivity-control").at(key), rows.at("none").at(key)) << scene << key;
    }
  }
}

}  // namespace
}  // namespace hapticwall::command::test
