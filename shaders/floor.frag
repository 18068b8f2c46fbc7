#version 330 core

in vec3 world_position;
in vec3 world_normal;

uniform vec4 colour;        // fades into the backdrop with distance
uniform vec4 line_colour;
uniform vec2 grid_origin;   // x and z of one crossing of the grid lines
uniform float grid_step;    // distance between grid lines
uniform vec4 block_x;       // footprint of the walls of axis x: min x, max x, min z, max z; 0: none
uniform vec4 block_y;       // the same for axis y
uniform float darkness;     // of the shadows, 0 to 1

out vec4 fragment;

const float kFadeFrom = 6.5;
const float kFadeTo = 16.0;
const vec2 kShadowReach = vec2(1.05, -1.40);  // shadow of the upper edges of the walls, away from the key light
const int kShadowSteps = 4;

float grid_line(float coordinate) {
  float distance_to_line = abs(fract(coordinate - 0.5) - 0.5);
  return 1.0 - smoothstep(0.0, 1.5 * fwidth(coordinate), distance_to_line);
}

// Distance from a point to a block; 0 inside.
float distance_to(vec4 block, vec2 point) {
  vec2 outside = max(max(block.xz - point, point - block.yw), vec2(0.0));
  return length(outside);
}

// Share of the light that the walls block: all light near their feet, the key light behind them.
float shadow_of(vec4 block, vec2 point) {
  float feet = 0.42 * exp(-1.9 * distance_to(block, point));
  float behind = 0.0;
  for (int i = 0; i < kShadowSteps; ++i) {
    float height = float(i) / float(kShadowSteps - 1);
    float away = distance_to(block, point - height * kShadowReach);
    behind = max(behind, 0.55 * (1.0 - 0.35 * height) * (1.0 - smoothstep(0.0, 0.15 + 0.7 * height, away)));
  }
  return max(feet, behind);
}

void main() {
  vec2 point = world_position.xz;
  vec2 cell = (point - grid_origin) / grid_step;
  float line = max(grid_line(cell.x), grid_line(cell.y));
  vec3 base = mix(colour.rgb, line_colour.rgb, line_colour.a * line);
  float shadow = 0.0;
  if (block_x.y > block_x.x) shadow = shadow_of(block_x, point);
  if (block_y.y > block_y.x) shadow = max(shadow, shadow_of(block_y, point));
  base *= 1.0 - darkness * shadow;
  float fade = smoothstep(kFadeFrom, kFadeTo, length(point)) + 0.0 * world_normal.y;
  fragment = vec4(base, 1.0 - clamp(fade, 0.0, 1.0));
}
