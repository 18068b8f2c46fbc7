// Shared by the tests of sessions: scenes, a controlled clock, recording devices, waiting.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/session/loop/clock.h"
#include "app/session/loop/exchange.h"
#include "core/algorithm/algorithm.h"
#include "core/sample.h"
#include "core/scene.h"
#include "device/device.h"
#include "tests/temporary_folder.h"

namespace hapticwall::session::test {

using hapticwall::test::lines_of;
using hapticwall::test::TemporaryFolder;
using hapticwall::test::text_of;

// Move of the hand to this place, as fast as a hand goes.
inline HandMove hand_to(double position_m, std::size_t axis = 0) {
  HandMove move;
  move.m.fill(std::numeric_limits<double>::quiet_NaN());
  move.m.at(axis) = position_m;
  move.to_place = move.at_once = true;
  return move;
}

// The paper's device, a firm hand that goes into the wall within some thirty ticks and stays there.
inline Scene contact_scene(double rate_hz = 1000.0) {
  Scene scene;
  scene.name = "contact";
  scene.sampling.rate_hz = rate_hz;
  scene.x().device.friction_n = 0.14;
  scene.x().device.encoder_m = 0.254e-3;
  scene.x().device.force_limit_n = 8.9;
  scene.x().device.start_m = 0.049;
  HandSettings hand;
  hand.mass_kg = 0.4;
  hand.stiffness_n_per_m = 250.0;
  hand.damping_n_s_per_m = 33.0;
  hand.grip_stiffness_n_per_m = 1000.0;
  hand.grip_damping_n_s_per_m = 1.0;
  hand.path = {{0.0, 0.049}, {0.05, 0.075}};
  scene.x().hand = hand;
  scene.x().walls = {{0.05, 35000.0, 0.0}};
  scene.algorithm.index = find_algorithm("virtual-coupling").value();
  return scene;
}

// Parameters for a loop with one axis.
inline LoopParameters parameters_of(const Scene& scene, std::uint32_t generation = 1,
                                    PlantModel* plant = nullptr) {
  return {{{{servo_settings(scene), plant}}}, generation};
}

inline Scene with_algorithm(Scene scene, std::size_t index) {
  scene.algorithm.index = index;
  return scene;
}

// A hand that goes into the wall and out of it for ten seconds, so that the handle moves whenever
// something is changed.
inline Scene moving_scene(double rate_hz = 1000.0) {
  Scene scene = contact_scene(rate_hz);
  scene.name = "moving";
  scene.x().hand->path = {};
  for (int turn = 0; turn < 50; ++turn) {
    scene.x().hand->path.edit().push_back({0.2 * turn, turn % 2 == 0 ? 0.045 : 0.058});
  }
  return scene;
}

// Variants of `scene`, each with another part of the plant changed, alone or with the algorithm or
// the wall: mass, damping, friction, hand, grip, encoder, limit, resolution, delay, lag, integrator
// and substeps. Precondition: a hand and a wall.
inline std::vector<Scene> plant_changes(Scene scene) {
  std::vector<Scene> changes;
  const auto change = [&](const std::function<void(Scene&)>& edit) {
    edit(scene);
    changes.push_back(scene);
  };
  change([](Scene& s) { s.x().device.mass_kg = 0.2; });
  change([](Scene& s) { s.x().device.damping_n_s_per_m = 2.5; });
  change([](Scene& s) { s.x().device.friction_n.reset(); });
  change([](Scene& s) { s.x().hand->grip_damping_n_s_per_m = 3.0; });
  change([](Scene& s) {
    s.x().hand->grip_stiffness_n_per_m.reset();
    s.x().hand->grip_damping_n_s_per_m.reset();
  });
  change([](Scene& s) { s.x().hand->mass_kg.reset(); });
  change([](Scene& s) { s.x().device.friction_n = 0.3; });
  change([](Scene& s) { s.x().device.delay_ticks = 3; });
  change([](Scene& s) { s.x().device.force_limit_n = 4.0; });
  change([](Scene& s) { s.x().device.amplifier_time_constant_s = 2e-3; });
  change([](Scene& s) { s.x().device.encoder_m.reset(); });
  change([](Scene& s) {
    s.x().hand->mass_kg = 0.3;
    s.x().hand->grip_stiffness_n_per_m = 2000.0;
  });
  change([](Scene& s) { s.x().device.force_resolution_n = 0.05; });
  change([](Scene& s) { s.x().device.max_force_rate_n_per_s = 2e3; });
  change([](Scene& s) { s.x().device.delay_ticks = 1; });
  change([](Scene& s) { s.simulator = {Integrator::kSemiImplicitEuler, 1}; });
  change([](Scene& s) { s.simulator.substeps = 10; });
  change([](Scene& s) { s.simulator = {Integrator::kRungeKutta4, 4}; });
  change([](Scene& s) { s.x().device.friction_n.reset(); });
  change([](Scene& s) { s.x().device.amplifier_time_constant_s.reset(); });
  change([](Scene& s) { s.simulator = {}; });
  change([](Scene& s) { s.x().device.encoder_m = 1e-4; });
  change([](Scene& s) {
    s.x().device.force_limit_n.reset();
    s.algorithm.index = (s.algorithm.index + 1) % algorithms().size();
  });
  change([](Scene& s) {
    s.x().device.delay_ticks.reset();
    s.x().device.force_resolution_n.reset();
    s.x().walls[0].stiffness_n_per_m = 10'000.0;
  });
  change([](Scene& s) { s.x().hand->stiffness_n_per_m = 400.0; });
  change([](Scene& s) { s.x().hand->damping_n_s_per_m = 10.0; });
  return changes;
}

// The energy balance error of a tick.
inline double balance_error_j(const Sample& sample) {
  const PlantTruth& truth = sample.truth;
  return truth.hand_work_j - (truth.kinetic_j + truth.dissipation_j + truth.actuator_work_j);
}

// Time passes only in sleep_until_ns().
class FakeClock : public Clock {
 public:
  [[nodiscard]] std::int64_t now_ns() override { return now_ns_; }
  void sleep_until_ns(std::int64_t deadline_ns) override {
    if (deadline_ns > now_ns_) now_ns_ = deadline_ns;
    if (after_sleep) after_sleep(*this);
  }
  void advance_ns(std::int64_t duration_ns) { now_ns_ += duration_ns; }

  std::function<void(FakeClock&)> after_sleep;

 private:
  std::int64_t now_ns_ = 1'000'000'000;
};

// A device without a plant that records its commands.
class FakeDevice : public device::Device {
 public:
  [[nodiscard]] device::DeviceInfo info() const override {
    device::DeviceInfo info{"fake", false, encoder_m, force_limit_n, {-1.0, 1.0, 10.0}};
    info.max_force_rate_n_per_s = max_force_rate_n_per_s;
    info.untried_share = untried_share;
    return info;
  }
  [[nodiscard]] Failure open() override {
    log.emplace_back("open");
    return open_failure;
  }
  [[nodiscard]] DeviceReading read() override {
    if (throw_at_read != 0 && ++reads == throw_at_read) throw std::runtime_error("unplugged");
    device_time_s += 1.0;  // between two reads its handle may move by 0.2 m
    return {position_m, age_s, state, device_time_s};
  }
  void enable(bool wanted) override { enabled = wanted; }
  [[nodiscard]] device::LinkStats link() const override { return figures; }
  void write(double force_n) override {
    if (throw_at_write) throw std::runtime_error("unplugged");
    forces_n.push_back(force_n);
    enabled_at_write.push_back(enabled);
    log.emplace_back("write");
  }
  void close() override { log.emplace_back("close"); }

  double position_m = 0.0;
  double age_s = 0.0;
  DeviceState state = DeviceState::kOk;
  double device_time_s = 0.0;
  double encoder_m = 0.0;
  double force_limit_n = 0.0;
  double max_force_rate_n_per_s = 0.0;
  double untried_share = 1.0;  // its handle never obeys
  device::LinkStats figures;
  Failure open_failure;
  int throw_at_read = 0;  // number of the read; 0: never
  bool throw_at_write = false;
  int reads = 0;
  bool enabled = false;
  std::vector<double> forces_n;
  std::vector<bool> enabled_at_write;
  std::vector<std::string> log;
};

// True as soon as `condition` holds. The deadline catches a broken program, not a slow one.
inline bool eventually(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    // A poll without a pause would take a core from the tests beside this one.
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

}  // namespace hapticwall::session::test
