#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;

uniform mat4 worldToClip;

out vec3 vPosition, vNormal;
out float vValue, vKnown;

void main() {
  vPosition = position;
  vNormal = normal;
  vValue = max(value, 0.0);
  vKnown = value >= 0.0 ? 1.0 : 0.0;
  gl_Position = worldToClip * vec4(position, 1.0);
}
