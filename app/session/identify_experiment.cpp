#include "app/session/identify_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "core/units.h"

namespace hapticwall::session {
namespace {

constexpr double kDefaultLimitN = 2.0;   // max without a choice
constexpr double kDefaultShare = 0.2;    // share of the device's force
constexpr double kBeforeStrokesS = 8.0;  // arming, rest and ramps take less
constexpr double kFinestEncoderM = 1e-7;

Result<double> limit_of(const IdentifyChoice& choice, double device_limit_n) {
  if (choice.limit_n == 0.0) {
    if (device_limit_n <= 0.0) return kDefaultLimitN;
    return std::min(kDefaultLimitN, kDefaultShare * device_limit_n);
  }
  if (device_limit_n <= 0.0 || choice.limit_n <= device_limit_n) return choice.limit_n;
  return usage_error(fmt::format("a limit of {:g} N: the device gives at most {:g} N",
                                 choice.limit_n, device_limit_n));
}

// The algorithm has no parameters and starts once, so only its step is implemented.
constexpr Algorithm kExperimentAlgorithm{
    {},
    [](void* /*state*/) {},
    [](void* /*state*/, const AlgorithmContext& /*context*/) {},
    [](void* /*state*/) {},
    [](void* state, const AlgorithmInput& input, std::span<double> /*signals*/) {
      return static_cast<ExperimentAlgorithm*>(state)->step(input);
    }};

bool has_whole_force(const ArmingStatus& arming) {
  return arming.state == ArmingState::kOn || arming.state == ArmingState::kNotNeeded;
}

}  // namespace

std::string why_not_identified(const std::string& option,
                               const std::optional<file::DeviceDescription>& own) {
  if (own || (option != "ff" && !option.starts_with("ff:"))) return "";
  return "--device ff: the torque of the wheel is unknown, and all numbers would be wrong with it; "
         "name a device file, docs/wheels.md: --device ff:mine.toml";
}

device::DeviceInfo info_on(device::DeviceInfo device, const Scene& scene) {
  if (!device.is_simulated) return device;
  device.encoder_m = scene.x().device.encoder_m.value_or(0.0);
  device.force_limit_n = scene.x().device.force_limit_n.value_or(0.0);
  return device;
}

Result<identify::ExperimentSettings> experiment_settings(const IdentifyChoice& choice,
                                                         const device::DeviceInfo& device,
                                                         double rate_hz) {
  const Result<double> limit_n = limit_of(choice, device.force_limit_n);
  if (!limit_n) return limit_n.error();
  identify::ExperimentSettings experiment;
  experiment.rate_hz = rate_hz;
  experiment.force_limit_n = *limit_n;
  experiment.encoder_m = device.encoder_m;
  experiment.peak_m = choice.travel_m;
  experiment.duration_s = choice.seconds;
  return experiment;
}

double longest_session_s(const identify::ExperimentSettings& experiment) {
  return experiment.duration_s + kBeforeStrokesS;
}

Scene identify_scene(const Scene& loaded, const identify::ExperimentSettings& experiment) {
  Scene scene;
  scene.name = "identify";
  scene.duration_s = longest_session_s(experiment);
  scene.sampling = loaded.sampling;
  scene.simulator = loaded.simulator;
  scene.x().device = loaded.x().device;
  scene.x().device.force_limit_n = experiment.force_limit_n;
  scene.x().walls.clear();
  scene.algorithm.index = *find_algorithm("none");
  return scene;
}

std::string let_go_text(const identify::ExperimentSettings& experiment) {
  return fmt::format(
      "let go of the handle: it moves by itself for {:.0f} s, {:.0f} mm to both sides, at up to "
      "{:.2g} N",
      longest_session_s(experiment), experiment.peak_m * kMillimetresPerMetre,
      experiment.force_limit_n);
}

file::DeviceDescription identified_description(const std::optional<file::DeviceDescription>& own,
                                               const std::string& option,
                                               const device::DeviceInfo& device,
                                               const Scene& scene) {
  if (own) return *own;
  file::DeviceDescription description;
  description.name = device.name;
  description.source = "hapticwall identify --device " + option;
  description.rate_hz = scene.sampling.rate_hz;
  description.x.force_limit_n =
      device.force_limit_n > 0.0 ? device.force_limit_n : *scene.x().device.force_limit_n;
  return description;
}

// cppcheck-suppress uninitDerivedMemberVar  ; the base is an aggregate
ExperimentAlgorithm::ExperimentAlgorithm(const identify::ExperimentSettings& settings)
    : BorrowedAlgorithm{&kExperimentAlgorithm, this}, experiment_(settings) {}

double ExperimentAlgorithm::step(const AlgorithmInput& input) {
  if (!begun()) {
    ++first_tick_;
    return 0.0;
  }
  if (ended()) return 0.0;
  const bool taken_away = wanted_n_ != 0.0 && input.previous_force_n == 0.0;
  const bool stopped = stopped_.load(std::memory_order_relaxed) || taken_away;
  wanted_n_ = stopped ? 0.0 : experiment_.step(input.position_m);
  first_stroke_.store(facts().first_stroke_tick, std::memory_order_relaxed);
  if (stopped || facts().state != identify::ExperimentState::kRunning) {
    ended_.store(true, std::memory_order_release);
  }
  return wanted_n_;
}

void IdentifyExperiment::add(const Tick& tick) {
  const Sample& sample = tick.x();
  if (algorithm_.begun() && why_.empty()) {
    if (position_m_.empty()) {
      kept_from_ = ticks_;
      lowest_m_ = highest_m_ = sample.position_m;
    } else if (sample.tick != next_tick_) {
      stop("ticks are missing from its record");
    }
    position_m_.push_back(sample.position_m);
    force_n_.push_back(sample.force_n);
    applied_n_.push_back(sample.applied_force_n);
    lowest_m_ = std::min(lowest_m_, sample.position_m);
    highest_m_ = std::max(highest_m_, sample.position_m);
    next_tick_ = sample.tick + 1;
  }
  ++ticks_;
}

bool IdentifyExperiment::look(const Snapshot& snapshot) {
  if (algorithm_.ended() || !why_.empty()) {
    if (snapshot.arming.state == ArmingState::kOff && why_.empty() &&
        facts().state == identify::ExperimentState::kRunning)
      why_ = arming_note_text(snapshot.arming.note);
    return true;
  }
  if (!algorithm_.begun()) {
    if (has_whole_force(snapshot.arming)) algorithm_.begin();
  } else if (snapshot.arming.state == ArmingState::kOff) {
    stop(std::string(arming_note_text(snapshot.arming.note)));
    return true;
  }
  if (snapshot.ended_by_fault) stop("the loop ended by a fault");
  return snapshot.ended_by_fault;
}

void IdentifyExperiment::stop(std::string why) {
  algorithm_.stop();
  if (why_.empty()) why_ = std::move(why);
}

IdentifyProgress IdentifyExperiment::progress() const {
  IdentifyProgress shown;
  if (position_m_.empty()) return shown;
  const std::uint64_t first_stroke = algorithm_.first_stroke();
  const auto seconds = [&](std::uint64_t ticks) {
    return static_cast<double>(ticks) / settings_.rate_hz;
  };
  const bool at_rest = seconds(position_m_.size()) < identify::kStillS;
  shown.stage = algorithm_.ended() ? IdentifyStage::kOver
                : first_stroke > 0 ? IdentifyStage::kStrokes
                : at_rest          ? IdentifyStage::kRest
                                   : IdentifyStage::kRamps;
  if (position_m_.size() > first_stroke && first_stroke > 0)
    shown.strokes_s = seconds(position_m_.size() - first_stroke);
  shown.lowest_m = lowest_m_ - position_m_.front();
  shown.highest_m = highest_m_ - position_m_.front();
  return shown;
}

Failure IdentifyExperiment::trouble() const {
  const auto off = [](std::string_view why) {
    return device_error(fmt::format("the experiment ended with the force off: {}", why));
  };
  if (!why_.empty()) return off(why_);
  if (!algorithm_.ended()) return device_error("the experiment did not finish in time");
  if (facts().state == identify::ExperimentState::kRunning) return off("the force was taken away");
  const std::string_view trouble = identify::experiment_trouble(facts().state);
  return trouble.empty() ? Failure() : off(trouble);
}

identify::Record IdentifyExperiment::record() const {
  identify::Record record;
  record.period_s = 1.0 / settings_.rate_hz;
  const std::size_t first =
      std::min<std::size_t>(algorithm_.first_tick() - kept_from_, position_m_.size());
  const std::size_t end = std::min<std::size_t>(first + facts().ticks, position_m_.size());
  const auto cut = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first),
                               values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  record.position_m = cut(position_m_);
  record.force_n = identify::taken_forces(cut(force_n_), cut(applied_n_));
  record.encoder_m = settings_.encoder_m;
  if (record.encoder_m <= 0.0) {
    record.encoder_m = std::max(identify::smallest_step(record.position_m), kFinestEncoderM);
  }
  return record;
}

}  // namespace hapticwall::session
