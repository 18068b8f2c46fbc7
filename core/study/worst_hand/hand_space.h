// The hands that the search tries: their numbers, the bounds of each, and a hand in a scene.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene.h"
#include "core/scene_keys.h"

namespace hapticwall::worst_hand {

// Our guess around the built-in scenes, no measurement of people. A winner often sits at a bound,
// so a result names its bounds.
enum class Bounds : std::uint8_t { kWide, kNarrow };
inline constexpr std::array<std::string_view, 2> kBoundsNames{"wide", "narrow"};

// Path of the hand. kLetGo: one point, so that no muscle works. kRamp: from the handle to that
// point at constant speed.
enum class Motion : std::uint8_t { kLetGo, kRamp };
inline constexpr std::array<std::string_view, 2> kMotionNames{"let-go", "ramp"};

struct HandNumber {
  std::string_view key;
  std::string_view unit;
  std::array<ValueRange, 2> ranges;  // in the order of Bounds
};
inline constexpr std::size_t kHandNumbers = 7;
// The numbers of a hand with this motion are the first ones of the list.
[[nodiscard]] constexpr std::size_t number_count(Motion motion) {
  return motion == Motion::kRamp ? kHandNumbers : kHandNumbers - 1;
}
// press_n: the force with which the hand would rest in the wall. speed_m_per_s: of a ramp.
inline constexpr std::array<HandNumber, kHandNumbers> kHandNumberList{
    {{"mass_kg", "kg", {{{0.005, 1.0}, {0.02, 1.0}}}},
     {"stiffness_n_per_m", "N/m", {{{20.0, 2000.0}, {50.0, 800.0}}}},
     {"damping_n_s_per_m", "N·s/m", {{{0.02, 40.0}, {1.0, 35.0}}}},
     {"grip_stiffness_n_per_m", "N/m", {{{100.0, 20000.0}, {300.0, 5000.0}}}},
     {"grip_damping_n_s_per_m", "N·s/m", {{{0.02, 20.0}, {1.0, 20.0}}}},
     {"press_n", "N", {{{0.2, 8.0}, {0.5, 5.0}}}},
     {"speed_m_per_s", "m/s", {{{0.01, 1.0}, {0.02, 0.5}}}}}};

using HandValues = std::array<double, kHandNumbers>;  // SI units, in the order of the list
// Places between the bounds on a logarithmic scale, 0 to 1 each.
using HandPoint = std::array<double, kHandNumbers>;

// The numbers of a hand have the same bits on every machine. Realtime-safe: yes.
[[nodiscard]] HandValues values_at(const HandPoint& point, Bounds bounds);

// True for a number within 1 % of one of its bounds. Realtime-safe: yes.
[[nodiscard]] bool is_at_bound(const HandValues& values, std::size_t number, Bounds bounds);

// Axis x with this hand. A hand that is let go owns the energy of its stretched spring and no more.
// A ramp starts at the handle, where nothing is stretched. Handle and hand start at rest.
// Precondition: problem_of() of the scene is nullopt. Realtime-safe: no.
[[nodiscard]] Scene with_hand(const Scene& scene, const HandValues& values,
                              Motion motion = Motion::kLetGo);

// The time of the path's last point, s: no muscle works from then on. 0 for a hand that is let go.
[[nodiscard]] double rest_s(const Scene& scene);

// The reason why a scene has no such search: no wall, a start in a wall, or a hand out of range.
// Realtime-safe: no.
[[nodiscard]] std::optional<SceneProblem> problem_of(const Scene& scene, Bounds bounds);

}  // namespace hapticwall::worst_hand
