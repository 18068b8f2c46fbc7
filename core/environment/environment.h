// The force of what the handle touches: the contract of an environment, and the list. The first one
// is the walls of the scene (walls.h), which a tick computes without a call. Another environment is
// a struct in a file of this folder and a line in environment_list.cpp:
//
//   struct Name {
//     static constexpr EnvironmentDescription kDescription{...};
//
//     // Takes period and parameters, and keeps the past.
//     void configure(const EnvironmentContext& context);
//     // Forgets the past, and keeps the parameters.
//     void reset();
//     // F_e at this place, and whether that is a contact. It changes nothing: an algorithm may ask
//     // for several places in one tick.
//     WallContact contact(const EnvironmentMotion& motion) const;
//     // The spring that stands for the environment at this place, N/m, above 0: virtual-coupling
//     // and energy-limited-spring need one.
//     double stiffness_hint(const EnvironmentMotion& motion) const;
//   };
//
// All are realtime-safe: bounded time, no allocation, no lock, no system call. Optional:
//
//     // Moves the environment's own state by one period, once per computation of the controller
//     // and after the algorithm. `applied_force_n`: F_d as commanded.
//     void advance(const EnvironmentMotion& motion, double applied_force_n);
//     // A number for each of kDescription.signals, of the last tick.
//     void show(std::span<double> signals) const;
//     // The first contradiction between the parameters, or nullopt.
//     static std::optional<SceneProblem> problem(const EnvironmentContext& context);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/environment/walls.h"
#include "core/environment_settings.h"

namespace hapticwall {

struct EnvironmentPlugin;  // core/environment/plugin/plugin_environment.h

// The handle at a tick, as one axis knows it. Positions as measured, velocities as estimated.
struct EnvironmentMotion {
  std::uint32_t axis = 0;  // of the force that is asked for: 0 is x, 1 is y
  bool two_axes = false;   // the scene has another axis
  double time_s = 0.0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double other_position_m = 0.0;  // of the other axis; 0 without one
  double other_velocity_m_per_s = 0.0;
};

// The part of a scene that an environment may use.
struct EnvironmentContext {
  double period_s = 1e-3;  // of the controller's computations
  const EnvironmentSettings* settings = nullptr;
  std::uint32_t axis = 0;

  // The value of a key if the scene names it. Realtime-safe: yes.
  [[nodiscard]] std::optional<double> value(std::string_view key) const;
  [[nodiscard]] double value_or(std::string_view key, double fallback) const {
    return value(key).value_or(fallback);
  }
};

using EnvironmentDescription = PartDescription;

// Room for the state in place, so that a change of environment allocates nothing.
inline constexpr std::size_t kMaxEnvironmentBytes = 128;

// The functions of an environment on a block of kMaxEnvironmentBytes, aligned for any type. A
// plug-in has none of them but `plugin`.
struct Environment {
  EnvironmentDescription description;
  void (*start)(void* state) = nullptr;
  void (*configure)(void* state, const EnvironmentContext& context) = nullptr;
  void (*reset)(void* state) = nullptr;
  WallContact (*contact)(const void* state, const EnvironmentMotion& motion) = nullptr;
  double (*stiffness_hint)(const void* state, const EnvironmentMotion& motion) = nullptr;
  void (*advance)(void* state, const EnvironmentMotion& motion, double force_n) = nullptr;
  void (*show)(const void* state, std::span<double> signals) = nullptr;
  std::optional<SceneProblem> (*problem)(const EnvironmentContext& context) = nullptr;
  const EnvironmentPlugin* plugin = nullptr;  // nullptr: built in
  bool has_stiffness_hint = true;             // false: the algorithms that need one are refused
};

// The functions of a struct. It is trivially copyable, because the next environment starts in the
// same block without a destructor call.
template <class Struct>
[[nodiscard]] constexpr Environment environment_of() {
  static_assert(sizeof(Struct) <= kMaxEnvironmentBytes);
  static_assert(alignof(Struct) <= alignof(std::max_align_t));
  static_assert(std::is_trivially_copyable_v<Struct> && std::is_trivially_destructible_v<Struct>);
  using Motion = EnvironmentMotion;
  Environment environment{Struct::kDescription};
  environment.start = [](void* state) { new (state) Struct{}; };
  environment.configure = [](void* state, const EnvironmentContext& context) {
    static_cast<Struct*>(state)->configure(context);
  };
  environment.reset = [](void* state) { static_cast<Struct*>(state)->reset(); };
  environment.contact = [](const void* state, const Motion& motion) {
    return static_cast<const Struct*>(state)->contact(motion);
  };
  environment.stiffness_hint = [](const void* state, const Motion& motion) {
    return static_cast<const Struct*>(state)->stiffness_hint(motion);
  };
  if constexpr (requires(Struct & s, const Motion& m) { s.advance(m, 0.0); }) {
    environment.advance = [](void* state, const Motion& motion, double force_n) {
      static_cast<Struct*>(state)->advance(motion, force_n);
    };
  }
  if constexpr (requires(const Struct& s, std::span<double> out) { s.show(out); }) {
    environment.show = [](const void* state, std::span<double> signals) {
      static_cast<const Struct*>(state)->show(signals);
    };
  }
  if constexpr (requires(const EnvironmentContext& context) { Struct::problem(context); })
    environment.problem = &Struct::problem;
  return environment;
}

// The list: walls, the other built-in environments, then plug-ins. Changes only while plug-ins are
// loaded, before other threads start. Realtime-safe: yes, all to read.
[[nodiscard]] const std::vector<Environment>& environments();
// Signals of the built-in environments.
[[nodiscard]] std::span<const SignalDescription> environment_signals();
// nullopt for a name outside of the list.
[[nodiscard]] std::optional<std::size_t> find_environment(std::string_view name);
// Union of all environments' keys, each once; EnvironmentSettings::values has this order.
[[nodiscard]] std::span<const ParameterDescription> environment_parameters();
// nullptr for the walls, which the tick computes without a call.
[[nodiscard]] const Environment* chosen_environment(const EnvironmentSettings& settings);
// Adds a plug-in's environment and its keys; returns its index. Precondition: there are less than
// kMaxEnvironments. Realtime-safe: no.
inline constexpr std::size_t kMaxEnvironments = 64;
std::size_t add_environment(const Environment& environment);

// Several environments share this key.
inline constexpr ParameterDescription kEnvironmentPosition = number_parameter(
    "position_m", "m", -1.0, 1.0, "0.05", "where it is: the surface of the tissue, or a detent");
inline constexpr double kDefaultEnvironmentPositionM = 0.05;

}  // namespace hapticwall
