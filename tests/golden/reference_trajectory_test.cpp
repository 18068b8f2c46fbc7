// The exact integrator against trajectories computed elsewhere with 200 decimal digits (README.md
// here).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "app/file/scene/scene_file.h"
#include "core/plant/plant_model.h"
#include "core/run/simulate.h"
#include "core/tick/servo.h"
#include "tests/paths.h"

namespace hapticwall {
namespace {

// tick, position_m, velocity_m_per_s, force_n, actuator_work_j, viscous_dissipation_j
using GoldenRow = std::array<double, 6>;

std::vector<GoldenRow> read_reference(const std::string& name) {
  std::ifstream file(test::data_folder() + "/golden/" + name);
  std::string line;
  std::getline(file, line);
  std::vector<GoldenRow> rows;
  while (std::getline(file, line)) {
    GoldenRow row{};
    const char* cursor = line.data();
    const char* end = line.data() + line.size();
    for (double& value : row) {
      cursor = std::from_chars(cursor, end, value).ptr;  // the last row has no force
      if (cursor < end && *cursor == ',') ++cursor;
    }
    rows.push_back(row);
  }
  return rows;
}

// The plant as `simulate` runs it, with its friction told apart: the reference counts viscous
// dissipation only.
class PlantDevice {
 public:
  explicit PlantDevice(const Scene& scene) : plant_(make_plant(scene)) {}
  DeviceReading read() {
    return {std::visit([](auto& plant) { return plant.position_m(); }, plant_), 0.0,
            DeviceState::kOk};
  }
  void write(double force_n) {
    std::visit([&](auto& plant) { plant.advance(force_n); }, plant_);
  }
  [[nodiscard]] double viscous_j() const {
    return std::visit([](const auto& plant) { return plant.energy().viscous_j; }, plant_);
  }

 private:
  PlantVariant plant_;
};

struct GoldenCase {
  std::string scene;
  std::string file;
  double position_tolerance_m;
};

std::ostream& operator<<(std::ostream& out, const GoldenCase& golden) {
  return out << golden.scene;
}

class ReferenceTrajectory : public ::testing::TestWithParam<GoldenCase> {};

double largest(const std::vector<GoldenRow>& rows, std::size_t column) {
  double value = 0.0;
  for (const GoldenRow& row : rows) value = std::max(value, std::abs(row[column]));
  return value;
}

TEST_P(ReferenceTrajectory, IsMetAtEveryTick) {
  const std::vector<GoldenRow> reference = read_reference(GetParam().file);
  ASSERT_EQ(reference.size(), 5001U);
  const auto loaded = file::load_scene(GetParam().scene);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;

  double position_error_m = 0.0;
  double work_error_j = 0.0;
  double force_error_n = 0.0;
  const auto compare = [&](const PlantTruth& truth, const GoldenRow& row) {
    position_error_m = std::max(position_error_m, std::abs(truth.position_m - row[1]));
    work_error_j = std::max(work_error_j, std::abs(truth.actuator_work_j - row[4]));
  };
  SimulationOptions options;
  options.on_sample = [&](const Sample& sample) {
    compare(sample.truth, reference[sample.tick]);
    force_error_n = std::max(force_error_n, std::abs(sample.force_n - reference[sample.tick][3]));
  };
  const SimulationResult result = simulate(loaded->scene, options);
  compare(result.final_state.truth, reference.back());

  std::printf("%s: position %.2g m, force %.2g N, actuator work %.2g of the largest\n",
              GetParam().scene.c_str(), position_error_m, force_error_n,
              work_error_j / largest(reference, 4));
  EXPECT_LE(position_error_m, GetParam().position_tolerance_m);
  EXPECT_LE(force_error_n, 35e3 * GetParam().position_tolerance_m + 1e-13);
  EXPECT_LE(work_error_j, 1e-12 * largest(reference, 4));
}

TEST_P(ReferenceTrajectory, DissipatesWhatItShould) {
  const std::vector<GoldenRow> reference = read_reference(GetParam().file);
  const auto loaded = file::load_scene(GetParam().scene);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  PlantDevice device(loaded->scene);
  Servo servo(servo_settings(loaded->scene));
  double error_j = 0.0;
  for (const GoldenRow& row : reference) {
    error_j = std::max(error_j, std::abs(device.viscous_j() - row[5]));
    servo.tick(device);
  }
  std::printf("%s: viscous dissipation %.2g of the largest\n", GetParam().scene.c_str(),
              error_j / largest(reference, 5));
  EXPECT_LE(error_j, 1e-12 * largest(reference, 5));
}

INSTANTIATE_TEST_SUITE_P(Golden, ReferenceTrajectory,
                         ::testing::Values(GoldenCase{"golden-soft", "soft.csv", 1e-15},
                                           GoldenCase{"golden-hard", "hard.csv", 1e-14},
                                           GoldenCase{"golden-soft-fric", "soft_fric.csv", 1e-15}),
                         [](const auto& param_info) {
                           std::string name = param_info.param.scene;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace hapticwall
