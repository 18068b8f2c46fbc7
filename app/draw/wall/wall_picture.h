// The visible state of walls, handle and hand, in metres and newtons: for the magnified contact,
// and for the wall view of the window. Independent of OpenGL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/draw/plot/sample_history.h"
#include "app/draw/plot/theme.h"
#include "core/sample.h"
#include "core/scene.h"

namespace hapticwall::draw {

// The device's axes. A device of one axis stays at y = 0.
enum class Axis : std::uint8_t { kX, kY };
inline constexpr std::size_t kAxisCount = 2;
[[nodiscard]] inline int index_of(Axis axis) { return static_cast<int>(axis); }

// Free space is on the side of the smaller coordinates.
struct PictureWall {
  Axis axis = Axis::kX;
  double face_m = 0.0;
  double stiffness_n_per_m = 0.0;

  friend bool operator==(const PictureWall&, const PictureWall&) = default;
};

// The stiffness that the walls of one axis display to the hand; wall_picture() leaves it to the
// view.
struct ShownStiffness {
  double n_per_m = 0.0;   // mean force over mean penetration
  double strength = 0.0;  // 0: nothing is displayed; 1: in contact; between while a tint fades

  friend bool operator==(const ShownStiffness&, const ShownStiffness&) = default;
};

// How far the values since the last frame reach below and above the newest; not negative.
struct Reach {
  glm::dvec2 below{0.0};
  glm::dvec2 above{0.0};

  friend bool operator==(const Reach&, const Reach&) = default;
};

// The tip of the handle is its position; the proxy is where the walls would hold that tip. The
// handle is drawn at the proxy, never in a wall; its true place is an outline.
struct WallPicture {
  bool two_axes = false;
  glm::dvec2 handle_m{0.0};  // true position
  Reach handle_reach_m;
  std::optional<glm::dvec2> hand_m;
  std::vector<PictureWall> walls;  // outermost wall of each axis first
  bool hides_stiffness = false;    // no number and no bar of it
  glm::dvec2 force_n{0.0};         // F_d; positive pushes out of the wall
  Reach force_reach_n;
  double full_scale_n = 10.0;  // the force with the longest arrow
  bool has_limit = false;      // the full scale is the force limit of the device
  bool saturated = false;
  std::array<ShownStiffness, kAxisCount> shown{};
  std::optional<Tone> verdict;  // its colour, for the edges of the walls on x; nullopt: their own

  friend bool operator==(const WallPicture&, const WallPicture&) = default;
};

// The values of one axis since the last frame that had new samples.
struct Swept {
  Extremes place_m;  // true positions of the handle
  Extremes force_n;
  std::uint64_t end_tick = 0;  // tick after the newest sample; 0: none yet
};
// Costs nothing without a new sample.
void note_swept(Swept& swept, const SampleHistory& history);

// `tick`: one sample for each axis of the scene.
[[nodiscard]] WallPicture wall_picture(const Scene& scene, const Tick& tick);
// wall_picture() for a scene of one axis.
[[nodiscard]] WallPicture wall_picture(const Scene& scene, const Sample& sample);
// Extends the picture of the present tick by the values since the last frame.
void sweep(WallPicture& picture, Axis axis, const Swept& swept);

// The first wall of an axis; null without one.
[[nodiscard]] const PictureWall* outermost_wall(const WallPicture& picture, Axis axis);

// The place where rigid walls would hold a tip: on every face that it has passed.
[[nodiscard]] glm::dvec2 held_by_walls(const WallPicture& picture, glm::dvec2 place_m);
// Place at which rigid walls would hold the handle. Nullopt out of contact.
[[nodiscard]] std::optional<glm::dvec2> proxy_of(const WallPicture& picture);

// The handle's place from the free side to the deepest since the last frame, both at the proxy.
struct SweptPlace {
  glm::dvec2 from_m{0.0};
  glm::dvec2 to_m{0.0};
};
[[nodiscard]] SweptPlace swept_place(const WallPicture& picture);
// The deepest place since the last frame, in truth. Nullopt if no wall was touched.
[[nodiscard]] std::optional<glm::dvec2> deepest_place(const WallPicture& picture);

// A force as a share of full scale; never longer than 1.
[[nodiscard]] glm::dvec2 force_share(const WallPicture& picture, glm::dvec2 force_n);
// The smallest and the largest force since the last frame, by their size on each axis.
struct SweptForce {
  glm::dvec2 least_n{0.0};
  glm::dvec2 most_n{0.0};
};
[[nodiscard]] SweptForce swept_force(const WallPicture& picture);

// Moves the shown tint towards the present one, `passed_s` later, because a chattering force would
// make it flicker. Strength and stiffness settle within about kTintTimeS.
inline constexpr double kTintTimeS = 0.12;
[[nodiscard]] ShownStiffness faded(const ShownStiffness& shown, const ShownStiffness& now,
                                   double passed_s);

// The colours of stiffness: logarithmic over two decades, up to the stiffest wall's own.
struct StiffnessScale {
  static constexpr double kDecades = 2.0;
  double stiffest_n_per_m = 1.0;

  [[nodiscard]] double softest_n_per_m() const;
  // Share from 0 at the softest to 1 at the stiffest, clamped.
  [[nodiscard]] float share(double n_per_m) const;
  // The stiffness of a share.
  [[nodiscard]] double at(double share) const;
};
[[nodiscard]] StiffnessScale stiffness_scale(const WallPicture& picture);
// The colour of a share.
[[nodiscard]] ImVec4 stiffness_colour(const Theme& theme, float share);

}  // namespace hapticwall::draw
