#version 450 core
// Diffuse surfaces lit by irradiance that was worked out at the vertices, or (TEXELS) at texels of an atlas.
#include "mesh.glsl"

#include "triangle.glsl"

in vec3 vFront, vBehind;

#ifdef TEXELS
#include "texels.glsl"
#include "behind.glsl"

vec3 irradianceHere() {
  uvec4 texel;
  vec4 share;
  texelsAround(barycentric(triangle()), texel, share);
  if (!gl_FrontFacing) texel = uvec4(behind[texel.x], behind[texel.y], behind[texel.z], behind[texel.w]);
  return any(equal(texel, uvec4(kNone))) ? vec3(0.0) : colourAround(texel, share);
}
#else
vec3 irradianceHere() {
  vec2 way = wayInside(triangle());
  vec3 front = INSIDE(vFront, way), behind = INSIDE(vBehind, way);
  return gl_FrontFacing ? front : behind;
}
#endif

void main() {
  vec3 irradiance = irradianceHere();
  Material material = materials[vObject];
  bool black = !gl_FrontFacing && material.albedo.w == 0.0;
  colour = vec4(black ? vec3(0.0) : sound(material.emission.rgb + material.albedo.rgb * irradiance / 3.14159265359), 1.0);
}
