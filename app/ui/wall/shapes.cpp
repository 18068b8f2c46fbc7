#include "app/ui/wall/shapes.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace hapticwall::ui {
namespace {

constexpr std::uint32_t kSegments = 32;  // around an axis
constexpr std::uint32_t kRings = 16;     // rings of a sphere, pole to pole

// A ring of vertices around the x axis.
void add_ring(Shape& shape, float x, float radius, float normal_x) {
  const float across = std::sqrt(std::max(0.0F, 1.0F - normal_x * normal_x));
  for (std::uint32_t i = 0; i <= kSegments; ++i) {
    const float angle =
        glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(kSegments);
    const float y = std::cos(angle);
    const float z = std::sin(angle);
    shape.vertices.push_back({{x, radius * y, radius * z}, {normal_x, across * y, across * z}});
  }
}

// Joins the last two rings, the earlier one having the smaller x.
void join_rings(Shape& shape) {
  const auto upper = static_cast<std::uint32_t>(shape.vertices.size()) - (kSegments + 1);
  const std::uint32_t lower = upper - (kSegments + 1);
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const std::array<std::uint32_t, 6> quad{lower + i, upper + i + 1, upper + i,
                                            lower + i, lower + i + 1, upper + i + 1};
    shape.indices.insert(shape.indices.end(), quad.begin(), quad.end());
  }
}

void add_lid(Shape& shape, float x, float normal_x) {
  // The lid is a flat cone; the order of the rings decides its front side.
  add_ring(shape, x, normal_x < 0.0F ? 0.0F : 1.0F, normal_x);
  add_ring(shape, x, normal_x < 0.0F ? 1.0F : 0.0F, normal_x);
  join_rings(shape);
}

// One side of the box around the origin.
void add_side(Shape& shape, int axis, float side) {
  glm::vec3 normal(0.0F);
  normal[axis] = side;
  glm::vec3 first(0.0F);
  first[(axis + 1) % 3] = 0.5F;
  const glm::vec3 second = glm::cross(normal, first);
  const auto start = static_cast<std::uint32_t>(shape.vertices.size());
  for (const glm::vec2 corner :
       {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
    shape.vertices.push_back({0.5F * normal + corner.x * first + corner.y * second, normal});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) shape.indices.push_back(start + i);
}

}  // namespace

Shape make_box() {
  Shape shape;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) add_side(shape, axis, side);
  }
  return shape;
}

Shape make_plane() {
  Shape shape;
  add_side(shape, 1, 1.0F);
  for (draw::Vertex& vertex : shape.vertices) vertex.position.y = 0.0F;
  return shape;
}

Shape make_face() {
  Shape shape;
  add_side(shape, 0, -1.0F);
  for (draw::Vertex& vertex : shape.vertices) vertex.position.x = 0.0F;
  return shape;
}

Shape make_sides() {
  Shape shape;
  add_side(shape, 0, 1.0F);
  for (const int axis : {1, 2}) {
    for (const float side : {-1.0F, 1.0F}) add_side(shape, axis, side);
  }
  for (draw::Vertex& vertex : shape.vertices) vertex.position.x += 0.5F;
  return shape;
}

Shape make_sphere() {
  Shape shape;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const float angle = glm::pi<float>() * static_cast<float>(ring) / static_cast<float>(kRings);
    add_ring(shape, -std::cos(angle), std::sin(angle), -std::cos(angle));
    if (ring > 0) join_rings(shape);
  }
  return shape;
}

Shape make_cylinder() {
  Shape shape;
  add_ring(shape, 0.0F, 1.0F, 0.0F);
  add_ring(shape, 1.0F, 1.0F, 0.0F);
  join_rings(shape);
  add_lid(shape, 0.0F, -1.0F);
  add_lid(shape, 1.0F, 1.0F);
  return shape;
}

Shape make_cone() {
  Shape shape;
  const float slope = glm::one_over_root_two<float>();
  add_ring(shape, 0.0F, 1.0F, slope);
  add_ring(shape, 1.0F, 0.0F, slope);
  join_rings(shape);
  add_lid(shape, 0.0F, -1.0F);
  return shape;
}

}  // namespace hapticwall::ui
