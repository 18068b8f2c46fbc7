// A live session without thread and clock: the test advances it tick by tick. The servo and the
// simulated device are real.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/session/live_session.h"
#include "app/session/loop/exchange.h"
#include "app/session/loop/sound_feed.h"
#include "app/session/scene_change.h"
#include "core/tick/servo.h"
#include "device/simulated_device.h"

namespace hapticwall::test {

class FakeSession final : public session::LiveSession {
 public:
  explicit FakeSession(const Scene& scene) : scene_(scene) {
    for (std::size_t i = 0; i < scene.axes.size(); ++i) axes_.emplace_back(axis_scene(scene, i));
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
      newest_.count = static_cast<std::uint8_t>(axes_.size());
      lead_hands();
      for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
        newest_.axes[axis] = axes_[axis].servo.tick(axes_[axis].device);
        newest_.axes[axis].generation = generation_;
      }
      queue_.push_back(newest_);
      if (feed->wanted) static_cast<void>(feed->ticks.try_push(newest_));
      if (recording_.state == session::RecordingState::kRecording) ++recording_.rows;
    }
  }

  [[nodiscard]] const Scene& scene() const override { return scene_; }
  std::optional<SceneProblem> change_scene(const Scene& wanted) override {
    if (auto problem = session::needs_new_session(scene_, wanted)) return problem;
    return take(wanted);
  }
  [[nodiscard]] std::uint32_t generation() const override { return generation_; }
  void add_event(std::string_view name, std::string_view more) override {
    events.push_back(std::string(name).append(more));
  }
  void move_hand(const session::HandMove& move) override {
    moves.push_back(move);
    if (move.at_once) ++gesture_;
    moves.back().gesture = gesture_;
    if (!queued_moves_->try_push(moves.back())) throw std::length_error("too many moves");
  }
  void slow_down(std::uint32_t periods) override { periods_per_tick = periods; }
  void arm(bool armed) override { arm_requests.push_back(armed); }
  void pause(bool paused) override { is_paused = paused; }
  void step(std::uint32_t ticks) override {
    steps += static_cast<int>(ticks);
    advance(static_cast<int>(ticks));
  }
  void reset() override {
    ++resets;
    newest_ = {};
    ++gesture_;
    hand_ = {};
    for (AxisLoop& axis : axes_) {
      axis.device.reset();
      axis.servo.reset();
    }
  }
  [[nodiscard]] session::Snapshot snapshot() override {
    session::Snapshot snapshot;
    snapshot.newest = newest_;
    if (!stalled) ++cycles_;
    snapshot.cycles = cycles_;
    snapshot.timing = timing;
    snapshot.arming = arming;
    snapshot.link = link;
    snapshot.paused = is_paused;
    snapshot.periods_per_tick = periods_per_tick;
    if (echoes) echoed_ = generation_;
    snapshot.generation = echoed_;
    return snapshot;
  }
  [[nodiscard]] std::shared_ptr<session::SoundFeed> sound_feed() const override { return feed; }
  void read_timing(session::TimingHistograms& out) const override { out = histograms; }
  std::size_t take_ticks(std::span<Tick> out) override {
    const std::size_t count = std::min(out.size(), queue_.size());
    std::copy_n(queue_.begin(), count, out.begin());
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  [[nodiscard]] std::uint64_t dropped_plot_samples() const override { return 0; }
  void record_signals(bool /*wanted*/) override {}
  [[nodiscard]] Failure start_recording(const std::string& csv_path) override {
    if (!refuse_recording.empty()) return Error{ErrorKind::kFile, refuse_recording};
    recording_ = {session::RecordingState::kRecording, 0, 0, csv_path, {}};
    return std::nullopt;
  }
  [[nodiscard]] Failure stop_recording() override {
    recording_.state = session::RecordingState::kIdle;
    return std::nullopt;
  }
  [[nodiscard]] session::RecordingStatus recording_status() const override { return recording_; }
  [[nodiscard]] Failure mark(std::string_view text) override {
    if (recording_.state != session::RecordingState::kRecording) {
      return Error{ErrorKind::kUsage, "marks belong to a recording: start one first"};
    }
    marks_.push_back({newest_.x().tick, file::mark_text(text)});
    return std::nullopt;
  }
  void name_mark(std::string_view text) override {
    if (marks_.empty()) throw std::logic_error("no mark to name");
    marks_.back().text = file::mark_text(text);
  }
  [[nodiscard]] std::span<const file::Mark> marks() const override { return marks_; }
  [[nodiscard]] const session::RealtimeStatus& realtime_status() const override {
    return realtime_;
  }

  [[nodiscard]] const device::DeviceInfo& device_info() const override { return info; }
  [[nodiscard]] std::string device_trouble() const override { return trouble; }
  [[nodiscard]] bool knows_truth() const override { return info.is_simulated; }

  device::DeviceInfo info{"simulator", true};
  std::string trouble;
  const std::shared_ptr<session::SoundFeed> feed = std::make_shared<session::SoundFeed>(1000);
  int* open_count = nullptr;     // decremented at the end of this session
  session::ArmingStatus arming;  // of the next snapshots, like link and timing
  device::LinkStats link;
  std::vector<bool> arm_requests;
  session::TimingStatistics timing;
  session::TimingHistograms histograms;
  std::uint32_t periods_per_tick = 1;
  bool is_paused = false;
  bool stalled = false;  // its loop gives no sign
  bool echoes = true;    // the next snapshot confirms the newest parameters
  int steps = 0;
  int resets = 0;
  std::vector<std::string> events;       // for the stream
  std::vector<session::HandMove> moves;  // asked for
  std::string refuse_recording;          // the error of the next recordings

 private:
  struct AxisLoop {
    explicit AxisLoop(const Scene& scene) : device(scene), servo(servo_settings(scene)) {}
    device::SimulatedDevice device;
    Servo servo;
  };

  void lead_hands() {
    session::LedHand::Places present_m{};
    for (std::size_t i = 0; i < axes_.size(); ++i)
      present_m[i] = axes_[i].device.truth()->hand_path_m;
    hand_.next_tick(*queued_moves_, gesture_, axes_.front().servo.settings().period_s(), present_m);
    for (std::size_t i = 0; hand_.leads() && i < axes_.size(); ++i)
      axes_[i].device.lead_hand_to(hand_.target_m()[i]);
  }

  std::optional<SceneProblem> take(const Scene& changed) {
    if (auto problem = validate(changed)) return problem;
    if (!same_plant(scene_, changed)) {
      plants_.push_back(std::make_unique<PlantModel>(changed));
      axes_.front().device.change_plant(*plants_.back());
    }
    if (!session::same_parameters(scene_, changed)) ++generation_;
    scene_ = changed;
    for (std::size_t i = 0; i < axes_.size(); ++i)
      axes_[i].servo.apply(servo_settings(axis_scene(scene_, i)));
    return std::nullopt;
  }

  Scene scene_;
  std::vector<std::unique_ptr<PlantModel>> plants_;
  std::deque<AxisLoop> axes_;
  std::uint64_t cycles_ = 0;
  Tick newest_;
  std::uint32_t generation_ = 1;
  std::uint32_t echoed_ = 1;
  std::deque<Tick> queue_;
  std::unique_ptr<session::SpscQueue<session::HandMove>> queued_moves_ =
      std::make_unique<session::SpscQueue<session::HandMove>>(session::kHandMoveQueueCapacity);
  session::LedHand hand_;
  std::uint32_t gesture_ = 0;
  session::RecordingStatus recording_;
  std::vector<file::Mark> marks_;
  session::RealtimeStatus realtime_;
};

}  // namespace hapticwall::test
