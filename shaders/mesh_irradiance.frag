#version 450 core
// Diffuse surfaces lit by irradiance that was worked out at the vertices.
#include "mesh.glsl"

in vec3 vFront, vBehind;

void main() {
  Material material = materials[vObject];
  bool black = !gl_FrontFacing && material.albedo.w == 0.0;
  vec3 irradiance = gl_FrontFacing ? vFront : vBehind;
  colour = vec4(black ? vec3(0.0) : sound(material.albedo.rgb * irradiance / 3.14159265359), 1.0);
}
