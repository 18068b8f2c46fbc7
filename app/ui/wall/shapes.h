// Solids of the wall view, around the origin.
#pragma once

#include <cstdint>
#include <vector>

#include "app/draw/figure/gl_objects.h"

namespace hapticwall::ui {

struct Shape {
  std::vector<draw::Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

[[nodiscard]] Shape make_box();       // edges of length 1
[[nodiscard]] Shape make_plane();     // edges of length 1, at y = 0, seen from above
[[nodiscard]] Shape make_face();      // edges of length 1, at x = 0, facing -x
[[nodiscard]] Shape make_sides();     // a box from x = 0 to 1 without the side at x = 0
[[nodiscard]] Shape make_sphere();    // radius 1
[[nodiscard]] Shape make_cylinder();  // radius 1, along x from 0 to 1, with lids
[[nodiscard]] Shape make_cone();      // base of radius 1 at x = 0, tip at x = 1

}  // namespace hapticwall::ui
