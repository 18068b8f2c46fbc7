#version 330 core

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 frame;  // from wall coordinates (into the wall, up, along its face) to the world
uniform mat4 view_projection;
uniform vec3 size;
uniform vec3 origin;  // centre of the face, in wall coordinates

out vec3 world_position;
out vec3 world_normal;
out vec2 on_wall;  // up and along the face

void main() {
  vec3 local = origin + size * position;
  vec4 world = frame * vec4(local, 1.0);
  world_position = world.xyz;
  world_normal = mat3(frame) * normal;
  on_wall = local.yz;
  gl_Position = view_projection * world;
}
