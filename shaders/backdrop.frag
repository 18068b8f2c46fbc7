#version 330 core

in vec3 world_position;
in vec3 world_normal;

uniform vec4 lower;
uniform vec4 upper;
uniform float height;  // of the picture, pixels

out vec4 fragment;

void main() {
  float up = gl_FragCoord.y / height + 0.0 * (world_position.x + world_normal.x);
  fragment = vec4(mix(lower.rgb, upper.rgb, up), 1.0);
}
