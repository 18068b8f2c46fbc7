#version 330 core

in vec3 world_position;
in vec3 world_normal;

uniform vec3 eye;
uniform vec4 colour;      // straight alpha
uniform float shininess;  // 0: matt
uniform float flatness;   // 0: lit; 1: its colour without lighting
uniform float shell;      // 0: solid; 1: only its outline is visible

out vec4 fragment;

const vec3 kKeyLight = vec3(-0.3970, 0.7500, 0.5294);  // unit vector towards the light
const vec3 kSky = vec3(0.66, 0.70, 0.76);
const vec3 kGround = vec3(0.34, 0.34, 0.36);

void main() {
  vec3 normal = normalize(world_normal);
  vec3 to_eye = normalize(eye - world_position);
  float facing = max(dot(normal, to_eye), 0.0);
  float key = max(dot(normal, kKeyLight), 0.0);
  vec3 ambient = mix(kGround, kSky, 0.5 + 0.5 * normal.y);
  vec3 lit = colour.rgb * (0.75 * ambient + 0.70 * key);
  // The 48th power, by squaring.
  float h = max(dot(normal, normalize(kKeyLight + to_eye)), 0.0);
  float h4 = h * h * h * h;
  float h16 = h4 * h4 * h4 * h4;
  float rim = (1.0 - facing) * (1.0 - facing) * (1.0 - facing);
  lit += shininess * (0.5 * h16 * h16 * h16 + 0.10 * rim);
  float outline = (1.0 - facing) * (1.0 - facing);
  fragment = vec4(mix(lit, colour.rgb, flatness), colour.a * mix(1.0, 0.12 + outline, shell));
}
