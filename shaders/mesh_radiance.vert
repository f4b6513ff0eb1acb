#version 450 core
// As mesh.vert, but light comes as transferred radiance. Where a triangle's three sets of coefficients fit
// between the stages they are interpolated on the way (INTERPOLATED); else the fragment shader fetches them.
#include "radiance.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 front;  // reflected beyond what the coefficients hold, on either side
layout(location = 3) in vec3 behind;
layout(location = 4) in uint object;

uniform mat4 worldToClip;

out vec3 vPosition, vNormal, vFront, vBehind;
flat out uint vObject;
#ifdef INTERPOLATED
out vec4 vLight[kLightSlots];
#endif

void main() {
  vPosition = position;
  vNormal = normal;
  vFront = front;
  vBehind = behind;
  vObject = object;
  gl_Position = worldToClip * vec4(position, 1.0);
#ifdef INTERPOLATED
  int at = 3 * kFunctions * gl_VertexID;
#define COPY(s) vLight[s] = vec4(radiance[at + 4 * s], radiance[at + 4 * s + 1], radiance[at + 4 * s + 2], radiance[at + 4 * s + 3]);
  FOR_EACH_LIGHT_SLOT(COPY)
#endif
}
