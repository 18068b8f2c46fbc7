#version 330 core

in vec3 world_position;
in vec3 world_normal;

uniform vec4 shadow;     // of a rod along x: min x, max x, z, radius
uniform float darkness;  // 0 to 1

out vec4 fragment;

void main() {
  vec2 nearest = vec2(clamp(world_position.x, shadow.x, shadow.y), shadow.z);
  float away = distance(world_position.xz, nearest) / shadow.w + 0.0 * world_normal.y;
  float soft = 1.0 - smoothstep(0.15, 2.3, away);
  fragment = vec4(0.0, 0.0, 0.0, darkness * soft * soft);
}
