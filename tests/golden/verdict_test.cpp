// The verdict of a run and the numbers behind it, against an independent program (verdicts.tsv).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"
#include "core/run/metrics.h"
#include "core/run/simulate.h"
#include "core/units.h"
#include "tests/paths.h"

namespace hapticwall {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) all.push_back(part);
  return all;
}

std::vector<Row> reference_rows() {
  std::ifstream file(test::data_folder() + "/golden/verdicts.tsv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> keys = parts(line, '\t');
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> values = parts(line, '\t');
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < keys.size(); ++i) row[keys[i]] = i < values.size() ? values[i] : "";
  }
  return rows;
}

Scene scene_of(const Row& row) {
  std::vector<std::string> overrides = parts(row.at("set"), ';');
  for (std::string& setting : overrides) {
    const std::string key = "hand.path_file=";
    if (setting.starts_with(key)) setting.insert(key.size(), test::data_folder() + "/golden/");
  }
  const auto loaded = file::load_scene(row.at("scene"), overrides);
  EXPECT_TRUE(loaded.ok()) << row.at("scene") << ": " << loaded.error().message;
  Scene scene = loaded->scene;
  scene.algorithm.index = find_algorithm(row.at("algorithm")).value();
  return scene;
}

// Six digits of the reference; below 1e-8 of the unit both are rounding.
void expect_number(const char* name, const std::string& reference, std::optional<double> value) {
  EXPECT_EQ(value.has_value(), !reference.empty()) << name;
  if (!value || reference.empty()) return;
  const double expected = std::stod(reference);
  EXPECT_NEAR(*value, expected, 5e-6 * std::abs(expected) + 1e-8) << name;
}

std::optional<double> scaled(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

TEST(ReferenceVerdict, IsThatOfTheSimulatorAndOfItsSamples) {
  const std::vector<Row> rows = reference_rows();
  ASSERT_EQ(rows.size(), 21U);
  for (const Row& row : rows) {
    SCOPED_TRACE(row.at("scene") + " under " + row.at("algorithm") + " " + row.at("set"));
    const Scene scene = scene_of(row);
    Metrics samples(scene, scene.tick_count(), SampleOrigin::kSimulator);
    SimulationOptions options;
    options.on_sample = [&](const Sample& sample) { samples.add(sample); };
    const Summary s = simulate(scene, options).summary;
    EXPECT_EQ(verdict_name(s.verdict), row.at("word"));
    expect_number("chatter", row.at("chatter_n"), s.chatter_n);
    expect_number("swing", row.at("swing_mm"), scaled(s.swing_m, kMillimetresPerMetre));
    expect_number("given", row.at("given_mj"), s.given_j * kMillijoulesPerJoule);
    // Without a contact the reference has a power of 0.
    expect_number("power", row.at("power_mw"), s.given_w.value_or(0.0) * kMilliwattsPerWatt);
    expect_number("shake", row.at("shake_m_per_s2"), s.shake_m_per_s2);
    const Summary again = samples.finish();
    EXPECT_EQ(again.verdict, s.verdict);
    EXPECT_EQ(again.chatter_n, s.chatter_n);
    EXPECT_EQ(again.swing_m, s.swing_m);
    EXPECT_EQ(again.shake_m_per_s2, s.shake_m_per_s2);
    EXPECT_EQ(again.given_j, s.given_j);
  }
}

// Measured columns alone, as a device has them.
TEST(ReferenceVerdict, IsFoundFromMeasuredColumns) {
  for (const Row& row : reference_rows()) {
    SCOPED_TRACE(row.at("scene") + " under " + row.at("algorithm") + " " + row.at("set"));
    const Scene scene = scene_of(row);
    Metrics samples(scene, scene.tick_count(), SampleOrigin::kDevice);
    SimulationOptions options;
    options.on_sample = [&](Sample sample) {
      sample.truth = {};
      samples.add(sample);
    };
    static_cast<void>(simulate(scene, options));
    const Summary s = samples.finish();
    EXPECT_EQ(verdict_name(s.verdict), row.at("word_as_device"));
    expect_number("chatter", row.at("device_chatter_n"), s.chatter_n);
    expect_number("swing", row.at("device_swing_mm"), scaled(s.swing_m, kMillimetresPerMetre));
    expect_number("power", row.at("device_power_mw"), s.given_w.value_or(0.0) * kMilliwattsPerWatt);
    EXPECT_FALSE(s.shake_m_per_s2.has_value());
  }
}

}  // namespace
}  // namespace hapticwall
