#version 330 core

in vec3 world_position;
in vec3 world_normal;
in vec2 on_wall;

uniform vec3 eye;
uniform vec4 colour;       // of the wall; straight alpha
uniform vec4 shown;        // colour of the displayed quantity, and its strength, 0 to 1
uniform vec4 contact;      // position of the handle, and its nearness, 0 to 1
uniform float grid_step;   // distance between the lines on the face; 0: no lines

out vec4 fragment;

const vec3 kKeyLight = vec3(-0.3970, 0.7500, 0.5294);  // unit vector towards the light
const vec3 kSky = vec3(0.80, 0.84, 0.88);
const vec3 kGround = vec3(0.52, 0.52, 0.54);
const float kShownRadius = 2.4;  // distance from the contact at which half the strength is left
const float kShadowRadius = 0.55;

float grid_line(float coordinate) {
  float distance_to_line = abs(fract(coordinate - 0.5) - 0.5);
  return 1.0 - clamp(distance_to_line / max(1.3 * fwidth(coordinate), 1e-6), 0.0, 1.0);
}

void main() {
  vec3 normal = normalize(world_normal);
  vec3 to_eye = normalize(eye - world_position);
  float facing = dot(normal, to_eye);
  normal = facing < 0.0 ? -normal : normal;
  vec3 from_contact = world_position - contact.xyz;
  float squared = dot(from_contact, from_contact);
  float falloff = 1.0 / (1.0 + squared / (kShownRadius * kShownRadius));
  float tint = shown.a * falloff;
  vec3 tinted = mix(colour.rgb, shown.rgb, tint);
  vec3 ambient = mix(kGround, kSky, 0.5 + 0.5 * normal.y);
  vec3 lit = tinted * (0.72 * ambient + 0.42 * max(dot(normal, kKeyLight), 0.0));
  if (grid_step > 0.0) {
    vec2 cell = on_wall / grid_step;
    lit *= 1.0 - 0.22 * max(grid_line(cell.x), grid_line(cell.y));
  }
  float near = squared / (kShadowRadius * kShadowRadius);
  lit *= 1.0 - 0.45 * contact.w / (1.0 + near * near);
  float rim = 1.0 - abs(facing);
  fragment = vec4(lit, colour.a + (1.0 - colour.a) * max(0.35 * rim * rim, 0.45 * tint));
}
