#version 330 core

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 model;
uniform mat3 normal_matrix;
uniform mat4 view_projection;

out vec3 world_position;
out vec3 world_normal;

void main() {
  vec4 world = model * vec4(position, 1.0);
  world_position = world.xyz;
  world_normal = normal_matrix * normal;
  gl_Position = view_projection * world;
}
