#include "tests/soak/researcher.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/file/recording/recording_reader.h"
#include "app/file/scene/scene_file.h"
#include "core/algorithm/algorithm.h"

namespace hapticwall::soak {
namespace {

constexpr std::uint64_t kTurnsASecond = 60;
constexpr std::uint64_t kMaxRecordingTurns = 10 * kTurnsASecond;
constexpr std::uint64_t kTurnsBetweenResets = 300 * kTurnsASecond;
constexpr int kPresses = 200;  // two seconds each: longer than from reset to reset
constexpr double kAwayM = 0.03;
constexpr double kPressedM = 0.06;

}  // namespace

Scene pressing_scene(double rate_hz) {
  auto loaded = file::load_scene("press");
  if (!loaded) throw std::runtime_error(loaded.error().message);
  Scene scene = std::move(loaded->scene);
  scene.sampling.rate_hz = rate_hz;
  scene.x().hand->path = {};
  for (int press = 0; press < kPresses; ++press) {
    scene.x().hand->path.edit().push_back({2.0 * press, kAwayM});
    scene.x().hand->path.edit().push_back({2.0 * press + 1.0, kPressedM});
  }
  return scene;
}

Researcher::Researcher(session::LiveSession& session, std::string csv_path, std::uint64_t seed)
    : session_(session), path_(std::move(csv_path)), random_(seed) {}

double Researcher::between(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_);
}

bool Researcher::once_in(int turns) {
  return std::uniform_int_distribution<int>(1, turns)(random_) == 1;
}

void Researcher::trouble(const std::string& text) {
  if (tally_.trouble.empty()) tally_.trouble = text;
}

void Researcher::turn(const std::function<void()>& on_reset) {
  take_ticks();
  ++turn_;
  if (turn_ % kTurnsBetweenResets == 0) {
    reset(on_reset);
    return;
  }
  act();
}

void Researcher::take_ticks() {
  std::array<Tick, 256> some;
  while (const std::size_t count = session_.take_ticks(some)) {
    std::for_each_n(some.begin(), count, [this](const Tick& tick) { look_at(tick.x()); });
  }
  if (session_.dropped_plot_samples() > 0) trouble("a sample was dropped on its way to the plots");
  if (session_.snapshot().ended_by_fault) trouble("the loop gave up");
}

void Researcher::look_at(const Sample& sample) {
  ++tally_.samples;
  const bool starts_again = start_expected_ && sample.tick == 0;
  if (sample.tick != next_tick_ && !starts_again) {
    trouble("tick " + std::to_string(sample.tick) + " came instead of " +
            std::to_string(next_tick_));
  }
  if (starts_again) start_expected_ = false;
  next_tick_ = sample.tick + 1;
  if ((sample.flags & kFlagInContact) != 0) ++tally_.contacts;
  tally_.largest_force_n = std::max(tally_.largest_force_n, std::abs(sample.force_n));
  const double limit_n = session_.scene().x().device.force_limit_n.value();
  if (!(std::abs(sample.force_n) <= limit_n)) {
    trouble("tick " + std::to_string(sample.tick) + ": a force of " +
            std::to_string(sample.force_n) + " N");
  }
}

// About something a second.
void Researcher::act() {
  const auto second = static_cast<int>(kTurnsASecond);
  if (once_in(2 * second)) change(&Researcher::another_algorithm);
  if (once_in(5 * second)) change(&Researcher::another_wall);
  if (once_in(10 * second)) change(&Researcher::another_device);
  if (once_in(20 * second)) change(&Researcher::another_integrator);
  if (leading_ ? once_in(3 * second) : once_in(15 * second)) leading_ = !leading_;
  lead_hand();
  if (paused_ ? once_in(second / 2) : once_in(30 * second)) {
    paused_ = !paused_;
    session_.pause(paused_);
  }
  if (paused_ && once_in(10)) session_.step(3);
  if (!recording_ && once_in(20 * second)) start_recording();
  if (recording_ && (turn_ >= recorded_until_turn_ || once_in(20 * second))) stop_recording();
}

void Researcher::change(void (Researcher::*how)(Scene&)) {
  Scene changed = session_.scene();
  (this->*how)(changed);
  if (const auto problem = session_.change_scene(changed)) {
    trouble(problem->key + ": " + problem->message);
  }
  ++tally_.changes;
}

void Researcher::another_algorithm(Scene& scene) {
  scene.algorithm.index =
      std::uniform_int_distribution<std::size_t>(0, algorithms().size() - 1)(random_);
}

void Researcher::another_wall(Scene& scene) {
  scene.x().walls[0].stiffness_n_per_m = std::pow(10.0, between(2.0, 5.0));
  scene.x().walls[0].damping_n_s_per_m = between(0.0, 2.0);
}

void Researcher::another_device(Scene& scene) {
  scene.x().device.mass_kg = between(0.03, 0.3);
  scene.x().device.damping_n_s_per_m = between(0.2, 3.0);
  if (once_in(2)) {
    scene.x().device.friction_n.reset();
  } else {
    scene.x().device.friction_n = between(0.02, 0.5);
  }
}

void Researcher::another_integrator(Scene& scene) {
  scene.simulator.integrator = once_in(2) ? Integrator::kExact : Integrator::kRungeKutta4;
  scene.simulator.substeps = scene.simulator.integrator == Integrator::kExact ? 1 : 20;
}

void Researcher::lead_hand() {
  if (leading_)
    session_.move_hand({.m = {between(kAwayM, kPressedM)}, .to_place = true, .at_once = true});
}

void Researcher::start_recording() {
  if (const Failure failed = session_.start_recording(path_)) {
    trouble(failed->message);
    return;
  }
  recording_ = true;
  recorded_until_turn_ = turn_ + kMaxRecordingTurns;
}

void Researcher::stop_recording() {
  recording_ = false;
  if (const Failure failed = session_.stop_recording()) trouble(failed->message);
  check_recording();
}

// Every row is read back: none missing, every number finite, and the sidecar's SHA-256 the file's.
void Researcher::check_recording() {
  ++tally_.recordings;
  tally_.rows += session_.recording_status().rows;
  const auto reader = file::RecordingReader::open(path_);
  if (!reader) {
    trouble(reader.error().message);
  } else {
    if ((*reader)->rows() != session_.recording_status().rows) trouble("a recording lost rows");
    for (const std::string& note : (*reader)->info().notes) trouble(note);
  }
  std::filesystem::remove(path_);
  std::filesystem::remove(std::filesystem::path(path_).replace_extension(".toml"));
}

void Researcher::reset(const std::function<void()>& on_reset) {
  if (recording_) stop_recording();
  const std::uint32_t before = session_.snapshot().resets;
  start_expected_ = true;
  session_.reset();
  while (session_.snapshot().resets == before && !session_.snapshot().ended_by_fault) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  take_ticks();
  ++tally_.resets;
  on_reset();
}

void Researcher::leave() {
  if (recording_) stop_recording();
  take_ticks();
}

}  // namespace hapticwall::soak
