#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 front;  // irradiance, on either side
layout(location = 3) in vec3 behind;
layout(location = 4) in uint object;

uniform mat4 worldToClip;

out vec3 vPosition, vNormal, vFront, vBehind;
flat out uint vObject;

void main() {
  vPosition = position;
  vNormal = normal;
  vFront = front;
  vBehind = behind;
  vObject = object;
  gl_Position = worldToClip * vec4(position, 1.0);
}
