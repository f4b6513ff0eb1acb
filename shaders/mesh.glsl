// What both mesh shaders share: what comes from the vertices, and what may leave.
#include "material.glsl"
#include "sound.glsl"

in vec3 vPosition, vNormal;
flat in uint vObject;
layout(location = 0) out vec4 colour;
