#version 330 core

in vec3 world_position;
in vec3 world_normal;

uniform vec4 colour;
uniform vec4 line_colour;
uniform vec4 backdrop;      // what the floor fades into
uniform float grid_origin;  // x of a grid line
uniform float grid_step;    // distance of grid lines
uniform vec4 shadow;        // x from, x to, radius, strength

out vec4 fragment;

const float kFadeFrom = 6.0;
const float kFadeTo = 17.0;

float grid_line(float coordinate) {
  float distance_to_line = abs(fract(coordinate - 0.5) - 0.5);
  return 1.0 - smoothstep(0.0, 1.5 * fwidth(coordinate), distance_to_line);
}

void main() {
  vec2 cell = vec2(world_position.x - grid_origin, world_position.z) / grid_step;
  float line = max(grid_line(cell.x), grid_line(cell.y));
  vec3 base = mix(colour.rgb, line_colour.rgb, 0.35 * line);
  float along = clamp(world_position.x, shadow.x, shadow.y);
  float away = distance(world_position.xz, vec2(along, 0.0));
  base *= 1.0 - shadow.w * (1.0 - smoothstep(0.2 * shadow.z, 2.2 * shadow.z, away));
  float fade = smoothstep(kFadeFrom, kFadeTo, length(world_position.xz)) + 0.0 * world_normal.y;
  fragment = vec4(mix(base, backdrop.rgb, clamp(fade, 0.0, 1.0)), 1.0);
}
