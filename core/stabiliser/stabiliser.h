// The contract of a stabilising algorithm and the closed list of them.
//
// An algorithm is a small class in a file of its own in this folder:
//
//   class Name {
//    public:
//     static constexpr AlgorithmDescription kDescription{"name", "Title", "one line", kParameters,
//                                                        "F_d = ..."};
//
//     // The parameters or the scene have changed; keeps state.
//     void configure(const StabiliserContext& context);
//
//     // Forgets everything.
//     void reset();
//
//     // F_d(k), newtons.
//     double step(const StabiliserInput& input);
//   };
//
// All members are realtime-safe: O(1), no allocation, no lock, no system call. step() may return
// any number; the servo step makes it finite and clamps it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/stabiliser/algorithm_settings.h"
#include "core/wall.h"

namespace hapticwall {

// What an algorithm may know of the scene.
struct StabiliserContext {
  double period_s = 1e-3;
  double device_damping_n_s_per_m = 0.0;
  double encoder_m = 0.0;  // 0: none
  WallSet walls;
  const AlgorithmSettings* settings = nullptr;

  // The value of a key where the scene names it. Realtime-safe: yes.
  [[nodiscard]] std::optional<double> value(std::string_view key) const;
  [[nodiscard]] double value_or(std::string_view key, double fallback) const {
    return value(key).value_or(fallback);
  }
};

// What an algorithm is told at tick k; signs as in docs/physics.md (x grows into the wall, F_d > 0
// pushes out of it).
struct StabiliserInput {
  double wall_force_n = 0.0;      // F_e(k)
  double position_m = 0.0;        // x_k as measured
  double displacement_m = 0.0;    // x_k - x_{k-1} as measured
  double velocity_m_per_s = 0.0;  // displacement / period
  double penetration_m = 0.0;     // into the outermost wall; negative in front of it
  double previous_force_n = 0.0;  // F_d(k-1) as really commanded, after the clamp
  bool in_contact = false;
};

struct AlgorithmDescription {
  std::string_view name;   // the word in the file, the menu, the command line and the CSV metadata
  std::string_view title;  // for people
  std::string_view idea;   // one line
  std::span<const ParameterDescription> parameters;
  std::string_view equation;  // for people: what the force is, in one to three lines
};

// The key with which a user tells an algorithm the device's damping; shared by several.
inline constexpr ParameterDescription kBelievedDampingParameter{
    "damping_n_s_per_m",    ParameterKind::kNumber,          "N·s/m", 0.0, 1e6, {},
    "the device's damping", "b as the algorithm believes it"};

// b as the algorithm believes it. Realtime-safe: yes.
[[nodiscard]] double believed_damping(const StabiliserContext& context);

// What every algorithm's force may pass through before it is commanded (followed_stabiliser.h). Of
// no single algorithm's keys, but in the union of them all.
inline constexpr std::array<std::string_view, 2> kFollowers{"none", "passivity-control"};
inline constexpr ParameterDescription kThenParameter{
    "then", ParameterKind::kChoice,
    "",     0.0,
    1.0,    kFollowers,
    "none", "what follows the algorithm: its force passes through a passivity controller"};
// Realtime-safe: yes.
[[nodiscard]] bool has_follower(const AlgorithmSettings& settings);

// ---- the closed list, as data (defined in stabiliser_list.cpp) ----

[[nodiscard]] std::span<const AlgorithmDescription> algorithms();
// Index in algorithms() of a name, or nothing.
[[nodiscard]] std::optional<std::size_t> find_algorithm(std::string_view name);
// Union of all algorithms' keys, each once; AlgorithmSettings::values follows this order.
[[nodiscard]] std::span<const ParameterDescription> algorithm_parameters();
[[nodiscard]] std::optional<std::size_t> find_algorithm_parameter(std::string_view key);
// "energy-bounding", "energy-bounding then passivity-control". Realtime-safe: no.
[[nodiscard]] std::string algorithm_label(const AlgorithmSettings& settings);
// Whether the algorithm of these settings, or what follows it, reads the key. Realtime-safe: yes.
[[nodiscard]] bool reads(const AlgorithmSettings& settings, std::string_view key);
// A value as a scene file has it: "true", "held-force", "0.01". Realtime-safe: no.
[[nodiscard]] std::string value_text(const ParameterDescription& parameter, double value);

}  // namespace hapticwall
