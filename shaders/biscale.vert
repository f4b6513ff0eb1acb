#version 450 core
layout(location = 0) in vec3 position;

uniform mat4 worldToClip;

out vec3 vPosition;

void main() {
  vPosition = position;
  gl_Position = worldToClip * vec4(position, 1.0);
}
