#version 330 core

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 frame;  // from wall coordinates (into the wall, up, along its face) to the world
uniform mat4 view_projection;
uniform vec3 size;
uniform vec3 origin;       // centre of the face, in wall coordinates
uniform vec4 dent;         // depth, width, and position: up, along
uniform float on_face;     // 1: the face, which bends

out vec3 world_position;
out vec3 world_normal;
out vec2 on_wall;  // up and along the face

void main() {
  vec3 local = origin + size * position;
  vec3 own_normal = normal;
  // The edges of the face are fixed, so the dent vanishes there.
  vec2 to_edge = 4.0 * (0.25 - position.yz * position.yz);
  float held = clamp(5.0 * min(to_edge.x, to_edge.y), 0.0, 1.0);
  vec2 away = local.yz - dent.zw;
  float width_squared = dent.y * dent.y;
  float depth = on_face * dent.x * held * exp(-0.5 * dot(away, away) / width_squared);
  local.x += depth;
  own_normal = mix(own_normal, normalize(vec3(-1.0, -depth * away / width_squared)), on_face);
  vec4 world = frame * vec4(local, 1.0);
  world_position = world.xyz;
  world_normal = mat3(frame) * own_normal;
  on_wall = local.yz;
  gl_Position = view_projection * world;
}
