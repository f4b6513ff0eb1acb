#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 irradiance;
layout(location = 3) in vec3 irradianceBehind;
layout(location = 4) in uint object;

uniform mat4 worldToClip;

out vec3 vPosition, vNormal, vIrradiance, vIrradianceBehind;
flat out uint vObject;

void main() {
  vPosition = position;
  vNormal = normal;
  vIrradiance = irradiance;
  vIrradianceBehind = irradianceBehind;
  vObject = object;
  gl_Position = worldToClip * vec4(position, 1.0);
}
