// The loop of a session on the whole link and an emulated device that lies, in virtual time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "app/session/loop/servo_loop.h"
#include "app/session/scene_change.h"
#include "tests/app/session/support.h"
#include "tests/device/link/link_rig.h"

namespace hapticwall::session::test {

inline constexpr double kLieWallM = 0.05;
inline constexpr double kLieStiffness = 600.0;  // stable with one tick of delay

// The device of a session over the link of a virtual host.
class LinkDevice : public device::Device {
 public:
  explicit LinkDevice(device::testing::VirtualHost& host) : host_(host) {}

  [[nodiscard]] device::DeviceInfo info() const override {
    const auto description = host_.owner.description();
    device::DeviceInfo info;
    info.name = "emulated";
    if (description) info.encoder_m = description->axis[0].encoder_m;
    if (description) info.force_limit_n = description->axis[0].force_limit_n;
    if (description) info.motion = description->axis[0].motion;
    if (description) info.max_force_rate_n_per_s = description->axis[0].max_force_rate_n_per_s;
    return info;
  }
  [[nodiscard]] Failure open() override { return std::nullopt; }
  [[nodiscard]] DeviceReading read() override {
    const device::AxesReading axes = host_.loop.read();
    return {axes.position_m[0], axes.age_s, axes.state, axes.device_time_s, axes.applied_n[0]};
  }
  void write(double force_n) override { host_.loop.write({force_n, 0.0}); }
  void enable(bool enabled) override { host_.loop.enable(enabled); }
  [[nodiscard]] device::LinkStats link() const override { return host_.loop.stats(); }
  void close() override {}

 private:
  device::testing::VirtualHost& host_;
};

// A hand that rests at 30 mm, or pushes 20 mm behind the wall's face after 0.7 s.
inline device::hid::EmulatorSettings held_device(bool in_contact) {
  device::hid::EmulatorSettings settings = device::hid::testing::one_axis();
  if (in_contact) settings.axes[0].x().hand->path = {{0.0, 0.03}, {0.7, 0.03}, {0.9, 0.07}};
  return settings;
}

class LieRig {
 public:
  LieRig(device::hid::FaultScript script, bool in_contact,
         const device::ImpulseEngineOptions& options = {})
      : LieRig(std::move(script), held_device(in_contact), options, scene(), nullptr) {}
  // `borrowed`: as in ServoLoop.
  LieRig(device::hid::FaultScript script, const device::hid::EmulatorSettings& settings,
         const device::ImpulseEngineOptions& options, const Scene& scene,
         BorrowedAlgorithm* borrowed)
      : rig(std::move(script), options, settings),
        device_(rig.host),
        exchange_(kQueues, parameters_of(scene)) {
    prepare(scene, borrowed);
  }
  // Rig with a board that speaks the dialect of `options`.
  LieRig(const device::ImpulseEngineOptions& options,
         std::unique_ptr<device::hid::testing::ForeignBoard> board,
         std::shared_ptr<device::hid::Port> port = nullptr,
         const std::function<void(device::testing::VirtualHost&)>& before = {})
      : rig(options, std::move(board)),
        device_(rig.host),
        exchange_(kQueues, parameters_of(scene())) {
    rig.host.other_port = std::move(port);
    if (before) before(rig.host);
    prepare(scene(), nullptr);
  }

  void arm() { EXPECT_TRUE(exchange_.commands.try_push({CommandKind::kArm, 0})); }
  // Changes the wall as a blind trial does, which puts the other of two walls in force.
  void change_wall(const WallSettings& wall) { change_touched(wall, 0); }
  // `environment`: an index in environments(); another one than the walls leaves these out.
  void change_touched(const WallSettings& wall, std::size_t environment) {
    Scene changed = scene_on(scene(), device_.info());
    changed.environment.index = environment;
    changed.x().walls = {wall};
    if (!changed.environment.is_walls()) changed.x().walls.clear();
    LoopParameters parameters = parameters_of(changed);
    parameters.generation = ++generation_;
    exchange_.parameters.publish(parameters);
  }
  void disarm() { EXPECT_TRUE(exchange_.commands.try_push({CommandKind::kDisarm, 0})); }
  void tick() { rig.host.tick(); }
  void until_ms(std::uint64_t time_ms) { rig.tick_until_ms(time_ms); }
  [[nodiscard]] std::uint64_t now_us() const { return rig.host.now_us(); }
  [[nodiscard]] Snapshot snapshot() {
    exchange_.snapshots.update();
    return exchange_.snapshots.current();
  }
  [[nodiscard]] ArmingStatus arming() { return snapshot().arming; }

  device::testing::Rig rig;
  std::uint64_t last_force_us = 0;
  double peak_n = 0.0;
  std::function<void()> on_tick;

 private:
  // Nobody takes the samples, and queues of the usual size would be nearly all of the time.
  static constexpr QueueCapacities kQueues{.plot = 1, .recorder = 1};

  static Scene scene() {
    Scene scene;
    scene.x().device.force_limit_n = device::hid::testing::kLimitN;
    scene.x().walls = {{kLieWallM, kLieStiffness, 0.0}};
    scene.algorithm.index = find_algorithm("none").value();
    return scene;
  }

  void prepare(const Scene& scene, BorrowedAlgorithm* borrowed) {
    EXPECT_TRUE(rig.host.come_up());
    loop_.emplace(std::vector<device::Device*>{&device_}, exchange_,
                  parameters_of(scene_on(scene, device_.info())), false, borrowed);
    rig.host.whole_loop = [this] { loop_->cycle({clock_.now_ns(), 0, 0}, clock_); };
    rig.host.after_tick = [this] {
      const double force_n = std::abs(rig.force_n());
      if (force_n != 0.0) last_force_us = rig.host.now_us();
      peak_n = std::max(peak_n, force_n);
      if (on_tick) on_tick();
    };
  }

  LinkDevice device_;
  Exchange exchange_;
  std::optional<ServoLoop> loop_;
  FakeClock clock_;
  std::uint32_t generation_ = 1;
};

}  // namespace hapticwall::session::test
