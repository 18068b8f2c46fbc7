#version 330 core

in vec3 world_position;
in vec3 world_normal;

uniform vec3 eye;
uniform vec4 colour;        // straight alpha
uniform float shininess;    // 0: matt
uniform float flatness;     // 0: lit; 1: its colour, whatever the light
uniform vec4 glow;          // centre of a glow on the surface, and its strength
uniform vec4 glow_colour;

out vec4 fragment;

const vec3 kKeyLight = normalize(vec3(-0.45, 0.85, 0.60));
const vec3 kSky = vec3(0.62, 0.68, 0.76);
const vec3 kGround = vec3(0.26, 0.27, 0.30);
const float kGlowRadius = 1.3;

void main() {
  vec3 normal = normalize(world_normal);
  vec3 to_eye = normalize(eye - world_position);
  float key = max(dot(normal, kKeyLight), 0.0);
  vec3 ambient = mix(kGround, kSky, 0.5 + 0.5 * normal.y);
  vec3 lit = colour.rgb * (ambient * 0.75 + key * 0.75);
  float highlight = pow(max(dot(normal, normalize(kKeyLight + to_eye)), 0.0), 48.0);
  float rim = pow(1.0 - max(dot(normal, to_eye), 0.0), 3.0);
  lit += shininess * (0.55 * highlight + 0.12 * rim);
  lit = mix(lit, colour.rgb, flatness);
  float near = 1.0 - smoothstep(0.0, kGlowRadius, distance(world_position, glow.xyz));
  lit = mix(lit, glow_colour.rgb, glow.w * near * near);
  fragment = vec4(lit, colour.a);
}
