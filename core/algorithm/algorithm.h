// An algorithm's description, its input and its functions; the list of algorithms; an algorithm at
// work. built_in.h shows how to write one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/algorithm/plugin/plugin_algorithm.h"
#include "core/algorithm_settings.h"
#include "core/environment/walls.h"
#include "core/sample.h"

namespace hapticwall {

class ActiveEnvironment;  // core/environment/active_environment.h

// The part of a scene that an algorithm may use.
struct AlgorithmContext {
  double period_s = 1e-3;
  double device_damping_n_s_per_m = 0.0;
  double encoder_m = 0.0;  // 0: none
  WallSet walls;
  const AlgorithmSettings* settings = nullptr;
  double force_limit_n = std::numeric_limits<double>::max();

  // The value of a key if the scene names it. Realtime-safe: yes.
  [[nodiscard]] std::optional<double> value(std::string_view key) const;
  [[nodiscard]] double value_or(std::string_view key, double fallback) const {
    return value(key).value_or(fallback);
  }
};

// The other axis of a scene at tick k, for an algorithm that acts on both.
struct OtherAxis {
  double wall_force_n = 0.0;
  double previous_force_n = 0.0;
  double displacement_m = 0.0;
  double velocity_m_per_s = 0.0;
  double damping_n_s_per_m = 0.0;  // b as the algorithm believes it
};

// The input of an algorithm at tick k; signs as in docs/physics.md (x grows into the wall, F_d > 0
// pushes out of it).
struct AlgorithmInput {
  double wall_force_n = 0.0;      // F_e(k)
  double position_m = 0.0;        // x_k as measured
  double displacement_m = 0.0;    // x_k - x_{k-1} as measured
  double velocity_m_per_s = 0.0;  // as estimated (core/estimator/)
  double penetration_m = 0.0;     // into the outermost wall; negative in front of it
  double previous_force_n = 0.0;  // F_d(k-1) as really commanded, after the clamp
  bool in_contact = false;
  // The environment whose force wall_force_n is, for questions about other places; nullptr: the
  // walls of the context. It lives during the call.
  const ActiveEnvironment* environment = nullptr;
  // nullptr: there is none, or the scene does not need it (ServoSettings::both_axes). It lives
  // during the call.
  const OtherAxis* other = nullptr;
};

struct AlgorithmDescription {
  std::string_view name;   // the word in the file, the menu, the command line and the CSV metadata
  std::string_view title;  // for people
  std::string_view idea;   // one line
  std::span<const ParameterDescription> parameters;
  std::string_view equation;  // for people: the force in one to three lines
  std::span<const SignalDescription> signals = {};
  // The first contradiction between the algorithm's keys, which are in range each. Checked in every
  // scene, whichever algorithm it names. nullptr: none is possible.
  std::optional<SceneProblem> (*problem)(const AlgorithmContext& context) = nullptr;
  std::string_view old_name = {};   // read like the name, never written; empty: none
  std::string_view forms_key = {};  // a comparison shows each choice of this key; empty: none
  // True if these settings need the other axis of the scene; nullptr: never.
  bool (*reads_other_axis)(const AlgorithmContext& context) = nullptr;
  bool needs_stiffness = false;  // it takes the environment for a spring: see stiffness_hint()
};

// The device's damping as the user states it; several algorithms share this key.
inline constexpr ParameterDescription kBelievedDampingParameter =
    number_parameter("damping_n_s_per_m", "N·s/m", 0.0, 1e6, "the device's damping",
                     "b as the algorithm believes it");

// b as the algorithm believes it: the key if the scene has it, else the device's damping.
// Realtime-safe: yes.
[[nodiscard]] double believed_damping(const AlgorithmContext& context);

// An algorithm's force may pass through a second algorithm, the follower. The key belongs to no
// single algorithm; it is in the union of all keys.
inline constexpr std::array<std::string_view, 2> kFollowers{"none", "passivity-control"};
inline constexpr ParameterDescription kThenParameter =
    choice_parameter("then", kFollowers,
                     "what follows the algorithm: its force passes through a passivity controller");
// Realtime-safe: yes.
[[nodiscard]] bool has_follower(const AlgorithmSettings& settings);

// ---- the list, as data: the closed list of built-in algorithms, then plug-ins ----

[[nodiscard]] std::span<const AlgorithmDescription> algorithms();
// Adds an algorithm, for add_plugin() alone; returns its index.
std::size_t add_algorithm(const AlgorithmDescription& algorithm);
// Index in algorithms() of a name, present or old. Realtime-safe: yes.
[[nodiscard]] std::optional<std::size_t> find_algorithm(std::string_view name);
// Index of the only follower. Realtime-safe: yes.
[[nodiscard]] std::size_t follower_index();
// Union of all algorithms' keys, each once; AlgorithmSettings::values has this order.
[[nodiscard]] std::span<const ParameterDescription> algorithm_parameters();
[[nodiscard]] std::optional<std::size_t> find_algorithm_parameter(std::string_view key);
// Union of the signals of all algorithms and environments, each once; Sample::signals has this
// order. Realtime-safe: yes, both.
[[nodiscard]] std::span<const SignalDescription> algorithm_signals();
[[nodiscard]] std::optional<std::size_t> find_algorithm_signal(std::string_view name);
// Names by place in Sample::signals; empty: no such signal.
using SignalNames = std::array<std::string, kMaxSignals>;
// Names of algorithm_signals(). Realtime-safe: no.
[[nodiscard]] SignalNames signal_names();
// "energy-bounding", "energy-bounding then passivity-control". Realtime-safe: no.
[[nodiscard]] std::string algorithm_label(const AlgorithmSettings& settings);
// A row of a comparison of algorithms.
struct ComparedAlgorithm {
  AlgorithmSettings settings;
  std::string label;  // "energy-bounding", "passivity-control (held-force)"
};
// The settings under each of these algorithms, indices in algorithms(): a row for each choice of an
// algorithm's `forms_key`, or for the one that the settings name. Realtime-safe: no.
[[nodiscard]] std::vector<ComparedAlgorithm> compared_algorithms(
    AlgorithmSettings settings, std::span<const std::size_t> indices);
// True if the algorithm of these settings or its follower reads the key. Realtime-safe: yes.
[[nodiscard]] bool reads(const AlgorithmSettings& settings, std::string_view key);
// True if the algorithm needs the other axis of the scene under these settings. Realtime-safe: yes.
[[nodiscard]] bool reads_other_axis(const AlgorithmSettings& settings);
// A value as a scene file shows it: "true", "held-force", "0.01". Realtime-safe: no.
[[nodiscard]] std::string value_text(const ParameterDescription& parameter, double value);

// ---- an algorithm at work ----

// An algorithm's description and its functions, realtime-safe as built_in.h says.
// `state` is a built-in one's block, a plug-in's PluginAlgorithm, or a borrowed object.
struct Algorithm {
  AlgorithmDescription description;
  void (*start)(void* state);  // begins without parameters and past; a built-in one, in its block
  void (*configure)(void* state, const AlgorithmContext& context);
  void (*reset)(void* state);
  double (*step)(void* state, const AlgorithmInput& in, std::span<double> signals);
};
inline constexpr std::size_t kMaxAlgorithmBytes = 512;  // of a built-in algorithm

// An algorithm of the program itself in the place of the scene's: an experiment on the device.
// Functions and state outlive the loop.
struct BorrowedAlgorithm {
  const Algorithm* functions;
  void* state;
};

// One algorithm on one axis. Realtime-safe: yes, except the constructor.
class ActiveAlgorithm {
 public:
  ActiveAlgorithm();

  // New settings or a new scene. A change of algorithm resets the state; nothing else does.
  void configure(std::size_t algorithm, const AlgorithmContext& context);
  // Makes this algorithm act, whichever configure() names.
  void borrow(const BorrowedAlgorithm& borrowed);
  [[nodiscard]] bool borrows() const {
    return elsewhere_ != nullptr && elsewhere_ != plugin_.get();
  }
  // Forgets the past, and keeps algorithm and parameters.
  void reset() { functions_->reset(state()); }
  // F_d(k), newtons, perhaps not finite. Call it once a tick: an algorithm may keep the past.
  [[nodiscard]] double step(const AlgorithmInput& input) {
    const std::span<double> values = std::span(values_).first(signals_);
    std::ranges::fill(values, std::numeric_limits<double>::quiet_NaN());
    return functions_->step(state(), input, values);
  }
  // The signals of the last step(), in their places.
  void show(Signals& signals) const {
    for (std::size_t i = 0; i < signals_; ++i) {
      if (places_[i] < kMaxSignals && std::isfinite(values_[i])) signals[places_[i]] = values_[i];
    }
  }

  [[nodiscard]] std::size_t algorithm() const { return algorithm_; }

 private:
  [[nodiscard]] void* state() { return elsewhere_ != nullptr ? elsewhere_ : block_.data(); }
  void find_places();

  const Algorithm* functions_;
  std::size_t algorithm_ = 0;
  void* elsewhere_ = nullptr;  // the state of a plug-in or a borrowed algorithm; nullptr: in block_
  std::size_t signals_ = 0;
  Signals values_{};
  std::array<std::size_t, kMaxSignals> places_{};
  alignas(std::max_align_t) std::array<std::byte, kMaxAlgorithmBytes> block_{};
  std::unique_ptr<PluginAlgorithm> plugin_;
};

}  // namespace hapticwall
