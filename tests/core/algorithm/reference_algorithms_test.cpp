// Every algorithm against tests/reference_algorithms.h, each on ten thousand random sequences of
// positions: with and without an encoder, with contacts, rests, resets, damped and layered walls,
// and with every parameter given or omitted. Where the order of operations is the same, forces are
// equal to the last bit; else they agree to kTolerance of the forces involved, each tick from the
// same past.
#include "tests/reference_algorithms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/position_bench.h"

namespace hapticwall {
namespace {

using testing::PositionBench;
using testing::ReferenceScene;
using testing::ReferenceState;
using testing::set_parameter;

constexpr int kSequences = 10000;
constexpr int kReferenceTicks = 100;
constexpr double kTolerance = 1e-12;

class Sequence {
 public:
  Sequence(const std::string& algorithm, std::uint64_t number) : random_(number) {
    settings_.algorithm.index = find_algorithm(algorithm).value();
    draw_scene();
    draw_algorithm();
  }

  [[nodiscard]] const ServoSettings& settings() const { return settings_; }
  [[nodiscard]] const ReferenceScene& scene() const { return scene_; }
  [[nodiscard]] bool resets() { return chance(0.01); }

  [[nodiscard]] double position() {
    const double wall_m = scene_.walls.front().at;
    if (chance(0.1)) speed_m_ = uniform(-1.0, 1.0) * std::pow(10.0, uniform(-7.0, -3.0));
    if (chance(0.1)) speed_m_ = 0.0;
    true_m_ += speed_m_;
    if (chance(0.05)) true_m_ = wall_m + uniform(-1e-3, 4e-3);
    if (chance(0.02)) true_m_ = wall_m;
    if (std::abs(true_m_ - wall_m) > 0.02) true_m_ = wall_m;
    // The last digits of a handle at rest.
    if (chance(0.05)) true_m_ += uniform(-1.0, 1.0) * std::pow(10.0, uniform(-18.0, -14.0));
    const double count_m = settings_.encoder_m;
    return count_m > 0.0 ? count_m * std::rint(true_m_ / count_m) : true_m_;
  }

 private:
  [[nodiscard]] double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] double log_uniform(double low, double high) {
    return low * std::pow(high / low, uniform(0.0, 1.0));
  }
  [[nodiscard]] bool chance(double share) { return uniform(0.0, 1.0) < share; }
  void set(std::string_view key, double value) { set_parameter(settings_.algorithm, key, value); }

  void draw_scene() {
    settings_.rate_hz = scene_.rate = chance(0.3) ? 1000.0 : log_uniform(100.0, 2e4);
    settings_.device_damping_n_s_per_m = scene_.b = log_uniform(0.01, 20.0);
    if (chance(0.6)) settings_.encoder_m = log_uniform(1e-6, 1e-3);
    scene_.limit = std::numeric_limits<double>::max();
    if (chance(0.7)) settings_.force_limit_n = scene_.limit = log_uniform(0.5, 100.0);
    std::vector<WallSettings> walls{{uniform(-0.05, 0.05), log_uniform(10.0, 1e6), 0.0}};
    while (walls.size() < 3 && chance(0.2)) {
      walls.push_back(
          {walls.back().position_m + log_uniform(1e-5, 3e-3), log_uniform(10.0, 1e6), 0.0});
    }
    for (WallSettings& wall : walls) {
      if (chance(0.3)) wall.damping_n_s_per_m = log_uniform(0.01, 30.0);
      scene_.walls.push_back({wall.position_m, wall.stiffness_n_per_m, wall.damping_n_s_per_m});
    }
    settings_.walls = WallSet(walls);
    true_m_ = walls.front().position_m;
  }

  void draw_algorithm() {
    if (chance(0.3)) set("damping_n_s_per_m", scene_.b = log_uniform(0.01, 20.0));
    const double period_s = 1.0 / scene_.rate;
    scene_.alpha_rest =
        settings_.encoder_m > 0.0 ? scene_.b * 0.0075 : std::numeric_limits<double>::max();
    if (chance(0.5)) set("rest_force_step_n", scene_.alpha_rest = log_uniform(1e-4, 1.0));
    scene_.c2 = scene_.b / period_s;
    if (chance(0.5)) set("storage_stiffness_n_per_m", scene_.c2 *= uniform(0.01, 1.0));
    if (chance(0.3)) {
      set("coupling_damping_n_s_per_m", scene_.coupling_damp = scene_.b * uniform(0.0, 1.0));
    }
    scene_.coupling = 2.0 * (scene_.b - scene_.coupling_damp) / period_s;
    if (chance(0.3)) set("coupling_stiffness_n_per_m", scene_.coupling = log_uniform(1.0, 1e6));
    scene_.alpha_most = scene_.b;
    if (chance(0.6)) set("max_damping_n_s_per_m", scene_.alpha_most = log_uniform(0.01, 1e4));
    if (chance(0.3)) set("velocity_floor_m_per_s", scene_.floor = log_uniform(1e-4, 0.1));
    for (const auto& [key, member] :
         {std::pair("observer", &ReferenceScene::held),
          std::pair("damping_credit", &ReferenceScene::credited),
          std::pair("reset_in_free_motion", &ReferenceScene::forgets)}) {
      if (chance(0.5)) set(key, 1.0), scene_.*member = true;
    }
    if (scene_.held && chance(0.5)) set("observer", 2.0), scene_.ahead = true;
  }

  std::mt19937_64 random_;
  ServoSettings settings_;
  ReferenceScene scene_;
  double true_m_ = 0.0;
  double speed_m_ = 0.0;
};

class ReferenceAlgorithm : public ::testing::TestWithParam<std::string> {};

// True if the reference rounds like the program.
bool is_exact(const std::string& algorithm, const ReferenceScene& scene) {
  if (algorithm == "energy-limited-spring") return scene.walls.size() == 1;
  return algorithm != "virtual-coupling" && algorithm != "energy-bounding-2010";
}

// Sum of the terms that may cancel within a force: dampers and opposing springs.
double forces_at_hand(const ReferenceScene& scene, const ReferenceState& state,
                      const Sample& sample) {
  double sum_n = (scene.b + scene.coupling_damp) * std::abs(sample.velocity_m_per_s);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const double damper_n_per_m = (scene.walls[i].damping + scene.coupling_damp) * scene.rate;
    sum_n += damper_n_per_m * state.proxies[i];
    if (scene.walls.size() > 1) {
      sum_n += scene.walls[i].stiffness * std::max(0.0, sample.penetration_m);
    }
  }
  return sum_n;
}

TEST_P(ReferenceAlgorithm, AgreesOnTenThousandSequences) {
  const std::string& algorithm = GetParam();
  int contacts = 0;
  int interventions = 0;
  for (int number = 0; number < kSequences; ++number) {
    Sequence sequence(algorithm, static_cast<std::uint64_t>(number));
    const bool exact = is_exact(algorithm, sequence.scene());
    PositionBench bench(sequence.settings());
    ReferenceState state;
    for (int tick = 0; tick < kReferenceTicks; ++tick) {
      if (sequence.resets()) {
        bench.reset();
        state = ReferenceState{};
      }
      const double before_n = state.force;
      const double x = sequence.position();
      const Sample sample = bench.move_to(x);
      const double wanted_n = testing::reference_force(algorithm, sequence.scene(), state, x);
      contacts += (sample.flags & kFlagInContact) != 0 ? 1 : 0;
      interventions += (sample.flags & kFlagIntervened) != 0 ? 1 : 0;
      if (exact) {
        ASSERT_EQ(sample.force_n, wanted_n) << number << ' ' << tick;
        continue;
      }
      const double scale_n =
          std::abs(before_n) + std::abs(wanted_n) + forces_at_hand(sequence.scene(), state, sample);
      ASSERT_NEAR(sample.force_n, wanted_n, kTolerance * scale_n) << number << ' ' << tick;
      state.force = sample.force_n;
    }
  }
  EXPECT_GT(contacts, kSequences * kReferenceTicks / 10);
  if (algorithm != "none") EXPECT_GT(interventions, kSequences);
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const AlgorithmDescription& algorithm : algorithms()) names.emplace_back(algorithm.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceAlgorithm, ::testing::ValuesIn(names()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace hapticwall
