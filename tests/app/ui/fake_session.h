// A live session without thread and clock: the test advances it tick by tick. The servo and the
// simulated device are real.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/runtime/session/live_session.h"
#include "app/runtime/session/scene_change.h"
#include "core/loop/servo.h"
#include "device/simulated_device.h"

namespace hapticwall::test {

class FakeSession final : public runtime::LiveSession {
 public:
  explicit FakeSession(const Scene& scene)
      : scene_(scene), device_(scene), servo_(servo_settings(scene)) {
    if (scene.two_axes()) second_ = std::make_unique<SecondAxisLoop>(axis_scene(scene, 1));
    realtime_.text = "driven by the test";
    realtime_.advice = "nothing is to be done";
  }

  ~FakeSession() override {
    if (open_count != nullptr) --*open_count;
  }
  FakeSession(const FakeSession&) = delete;
  FakeSession& operator=(const FakeSession&) = delete;

  // Advances by `ticks`, also while paused.
  void advance(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      newest_.axes[0] = servo_.tick(device_);
      newest_.axes[0].generation = generation_;
      if (second_) newest_.axes[1] = second_->servo.tick(second_->device);
      newest_.count = second_ ? 2 : 1;
      queue_.push_back(newest_);
      if (recording_.state == runtime::RecordingState::kRecording) ++recording_.rows;
    }
  }

  [[nodiscard]] const Scene& scene() const override { return scene_; }
  std::optional<SceneProblem> change_scene(const Scene& wanted) override {
    if (auto problem = runtime::needs_new_session(scene_, wanted)) return problem;
    return take(wanted);
  }
  [[nodiscard]] std::uint32_t generation() const override { return generation_; }
  void lead_hand(std::optional<double> position_m) override {
    lead = position_m;
    ++lead_calls;
    if (position_m) {
      device_.lead_hand_to(*position_m);
    } else {
      device_.release_hand();
    }
  }
  void lead_second_hand(std::optional<double> position_m) override { second_lead = position_m; }
  void arm(bool armed) override { arm_requests.push_back(armed); }
  void pause(bool paused) override { is_paused = paused; }
  void step(std::uint32_t ticks) override {
    steps += static_cast<int>(ticks);
    advance(static_cast<int>(ticks));
  }
  void reset() override {
    ++resets;
    device_.reset();
    servo_.reset();
    newest_ = {};
    if (second_) {
      second_->device.reset();
      second_->servo.reset();
    }
  }
  [[nodiscard]] runtime::Snapshot snapshot() override {
    runtime::Snapshot snapshot;
    snapshot.newest = newest_;
    snapshot.timing = timing;
    snapshot.arming = arming;
    snapshot.link = link;
    snapshot.paused = is_paused;
    if (echoes) echoed_ = generation_;
    snapshot.generation = echoed_;
    return snapshot;
  }
  void read_timing(runtime::TimingHistograms& out) const override { out = histograms; }
  std::size_t take_ticks(std::span<Tick> out) override {
    const std::size_t count = std::min(out.size(), queue_.size());
    std::copy_n(queue_.begin(), count, out.begin());
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  [[nodiscard]] std::uint64_t dropped_plot_samples() const override { return 0; }
  [[nodiscard]] Failure start_recording(const std::string& csv_path) override {
    if (!refuse_recording.empty()) return Error{ErrorKind::kFile, refuse_recording};
    recording_ = {runtime::RecordingState::kRecording, 0, 0, csv_path, {}};
    return std::nullopt;
  }
  [[nodiscard]] Failure stop_recording() override {
    recording_.state = runtime::RecordingState::kIdle;
    return std::nullopt;
  }
  [[nodiscard]] runtime::RecordingStatus recording_status() const override { return recording_; }
  [[nodiscard]] Failure mark(std::string_view text) override {
    if (recording_.state != runtime::RecordingState::kRecording) {
      return Error{ErrorKind::kUsage, "marks belong to a recording: start one first"};
    }
    marks_.push_back({newest_.x().tick, file::mark_text(text)});
    return std::nullopt;
  }
  [[nodiscard]] std::span<const file::Mark> marks() const override { return marks_; }
  [[nodiscard]] const runtime::RealtimeStatus& realtime_status() const override {
    return realtime_;
  }

  [[nodiscard]] const device::DeviceInfo& device_info() const override { return info; }
  [[nodiscard]] std::string device_trouble() const override { return trouble; }
  [[nodiscard]] bool knows_truth() const override { return info.is_simulated; }

  device::DeviceInfo info{"simulator", true};
  std::string trouble;
  int* open_count = nullptr;     // one less when this session has ended
  runtime::ArmingStatus arming;  // what the next snapshots say, like these
  device::LinkStats link;
  std::vector<bool> arm_requests;
  runtime::TimingStatistics timing;  // what the next snapshots say
  runtime::TimingHistograms histograms;
  bool is_paused = false;
  bool echoes = true;  // what was asked for is in force in the next snapshot
  int steps = 0;
  int resets = 0;
  int lead_calls = 0;
  std::optional<double> lead;
  std::optional<double> second_lead;
  std::string refuse_recording;  // the error of the next recordings

 private:
  std::optional<SceneProblem> take(const Scene& changed) {
    if (auto problem = validate(changed)) return problem;
    if (!same_plant(scene_, changed)) {
      plants_.push_back(std::make_unique<PlantModel>(changed));
      device_.change_plant(*plants_.back());
    }
    if (!runtime::same_parameters(scene_, changed)) ++generation_;
    scene_ = changed;
    servo_.apply(servo_settings(scene_));
    if (second_) second_->servo.apply(servo_settings(axis_scene(scene_, 1)));
    return std::nullopt;
  }

  Scene scene_;
  std::vector<std::unique_ptr<PlantModel>> plants_;
  device::SimulatedDevice device_;
  Servo servo_;
  Tick newest_;
  std::uint32_t generation_ = 1;
  std::uint32_t echoed_ = 1;
  std::deque<Tick> queue_;
  // The second axis, where the scene has one.
  struct SecondAxisLoop {
    explicit SecondAxisLoop(const Scene& scene) : device(scene), servo(servo_settings(scene)) {}
    device::SimulatedDevice device;
    Servo servo;
  };
  std::unique_ptr<SecondAxisLoop> second_;
  runtime::RecordingStatus recording_;
  std::vector<file::Mark> marks_;
  runtime::RealtimeStatus realtime_;
};

}  // namespace hapticwall::test
