#version 450 core
// Exit radiance of the surface under the light that transfer brings to it.
#include "environment.glsl"
#include "material.glsl"

in vec3 vPosition, vNormal, vIrradiance;
flat in uint vObject;
layout(location = 0) out vec4 colour;

void main() {
  Material material = materials[vObject];
  if (!gl_FrontFacing && material.albedo.w == 0.0) {
    colour = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  vec3 radiance = material.albedo.rgb / kPi * max(vIrradiance, vec3(0.0));
  colour = vec4(radiance, 1.0);
}
