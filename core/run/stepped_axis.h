// One axis of a scene on the simulator, a tick at a time, for a caller that moves the hand itself.
#pragma once

#include <cstdint>
#include <memory>

#include "core/plant/plant_model.h"
#include "core/sample.h"
#include "core/scene.h"
#include "core/tick/servo.h"

namespace hapticwall {

// A tick is compute(), then whatever the hand does, then advance(). Same bits as simulate().
// Realtime-safe: compute() and advance().
class SteppedAxis {
 public:
  // Axis x of a validated scene.
  explicit SteppedAxis(const Scene& scene)
      : scene_(scene), servo_(servo_settings(scene)), plant_(std::make_unique<PlantModel>(scene)) {}

  // The sample of this tick. Null if the handle is out of reach or a force was not finite: the run
  // has diverged at tick(), and there is no further tick.
  [[nodiscard]] const Sample* compute() {
    if (diverged_ || plant_->has_diverged()) {
      diverged_ = true;
      return nullptr;
    }
    tick_ = servo_.state().tick;
    Device device{*plant_};
    take(servo_.tick(device), device);
    return diverged_ ? nullptr : &sample_;
  }
  // compute() for two axes that need each other. False: one of them has diverged.
  [[nodiscard]] static bool compute_together(SteppedAxis& x, SteppedAxis& y) {
    if (x.diverged() || y.diverged()) return false;
    Device device_x{*x.plant_};
    Device device_y{*y.plant_};
    x.tick_ = y.tick_ = x.servo_.state().tick;
    const auto samples = Servo::tick_together(x.servo_, device_x, y.servo_, device_y);
    x.take(samples[0], device_x);
    y.take(samples[1], device_y);
    return !x.diverged_ && !y.diverged_;
  }
  // True if compute() needs the other axis, so that the two call compute_together().
  [[nodiscard]] bool needs_other_axis() const { return servo_.settings().both_axes; }
  // Of the last tick.
  [[nodiscard]] const Sample& sample() const { return sample_; }
  // Passes the time to the next tick.
  void advance() {
    plant_->advance(force_n_);
    tick_ = servo_.state().tick;
  }

  // Takes a scene that a session may change to, at this tick. The new plant takes over the state.
  void change(Scene changed);

  // The next tick to compute, or the tick at which the axis diverged.
  [[nodiscard]] std::uint64_t tick() const { return tick_; }
  [[nodiscard]] bool diverged() const { return diverged_ || plant_->has_diverged(); }
  [[nodiscard]] PlantModel& plant() { return *plant_; }
  [[nodiscard]] const PlantModel& plant() const { return *plant_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }

 private:
  // The servo's device: one write() is one tick.
  struct Device {
    PlantModel& plant;
    double force_n = 0.0;

    [[nodiscard]] DeviceReading read() const {
      return {plant.measured_position_m(), 0.0, DeviceState::kOk};
    }
    void write(double newtons) { force_n = newtons; }
    [[nodiscard]] const PlantTruth* truth() const { return &plant.truth(); }
  };

  void take(const Sample& sample, const Device& device) {
    sample_ = sample;
    force_n_ = device.force_n;
    diverged_ = servo_.state().failed;
  }

  Scene scene_;
  Servo servo_;
  std::unique_ptr<PlantModel> plant_;
  Sample sample_;
  double force_n_ = 0.0;
  std::uint64_t tick_ = 0;
  bool diverged_ = false;
};

}  // namespace hapticwall
