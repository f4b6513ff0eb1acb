#version 450 core
// Surfaces lit by transferred radiance: coefficients interpolated over the triangle meet the response of
// the material, to the pixel's own normal and view.
//   INTERPOLATED  coefficients arrive interpolated
//   EVERYWHERE    the same light at every vertex
//   TEXELS        they are fetched at the texels around the pixel
//   otherwise     they are fetched at the triangle's corners: for back sides, and for more bands than fit
//                 between the stages
#include "mesh.glsl"
#include "radiance.glsl"
#include "response.glsl"
#include "triangle.glsl"
#include "behind.glsl"

in vec3 vFront, vBehind;  // reflected beyond what the coefficients hold
uniform vec4 viewer;  // where, w = 1; or in which direction, w = 0

#if defined(INTERPOLATED)
in vec4 vLight[kLightSlots];
vec4 inside[kLightSlots];
#define NUMBER(n) inside[(n) / 4][(n) % 4]
#define COEFFICIENT(i) vec3(NUMBER(3 * i), NUMBER(3 * i + 1), NUMBER(3 * i + 2))
#elif defined(EVERYWHERE)
uniform vec3 light[kFunctions];
#define COEFFICIENT(i) light[i]
#else
vec3 fetch(uint at) { return vec3(radiance[at], radiance[at + 1], radiance[at + 2]); }
#ifdef TEXELS
#include "texels.glsl"
#define COEFFICIENT(i) (weight.x * fetch(at.x + 3 * i) + weight.y * fetch(at.y + 3 * i) + weight.z * fetch(at.z + 3 * i) + weight.w * fetch(at.w + 3 * i))
#else
#define COEFFICIENT(i) (weight.x * fetch(at.x + 3 * i) + weight.y * fetch(at.y + 3 * i) + weight.z * fetch(at.z + 3 * i))
#endif
#endif

// Unit normal on the side that is seen; the face's own where the shading normals cancel.
vec3 seenNormal(vec3 normal) {
  if (dot(normal, normal) < 1e-12) {
    uvec3 t = triangle();
    normal = cross(positionOf(t.y) - positionOf(t.x), positionOf(t.z) - positionOf(t.x));
  }
  return (gl_FrontFacing ? 1.0 : -1.0) * normalize(normal);
}

void main() {
  vec2 way = wayInside(triangle());
  vec3 front = INSIDE(vFront, way), behindThere = INSIDE(vBehind, way), smoothNormal = INSIDE(vNormal, way);
#ifdef INTERPOLATED
  for (int s = 0; s < kLightSlots; ++s) inside[s] = INSIDE(vLight[s], way);
#endif
  Material material = materials[vObject];
  colour = vec4(0.0, 0.0, 0.0, 1.0);
  if (!gl_FrontFacing && material.albedo.w == 0.0) return;
  vec3 exitDiffuse = gl_FrontFacing ? front : behindThere;
#if defined(TEXELS)
  uvec4 at;
  vec4 weight;
  texelsAround(barycentric(triangle()), at, weight);
  if (!gl_FrontFacing) at = uvec4(behind[at.x], behind[at.y], behind[at.z], behind[at.w]);
  if (any(equal(at, uvec4(kNone)))) return;
  exitDiffuse = colourAround(at, weight);
  at *= 3u * uint(kFunctions);
#elif !defined(INTERPOLATED) && !defined(EVERYWHERE)
  uvec3 t = triangle();
  uvec3 at = gl_FrontFacing ? t : uvec3(behind[t.x], behind[t.y], behind[t.z]);
  if (any(equal(at, uvec3(kNone)))) return;
  vec3 weight = barycentric(t);
  at *= 3u * uint(kFunctions);
#endif

  vec3 normal = seenNormal(smoothNormal), exitGlossy = vec3(0.0);
  float response[kFunctions];
  shEvaluate(normal, response);
#define DIFFUSE(i, l) if (kCosine[l] != 0.0) exitDiffuse += kCosine[l] * response[i] * COEFFICIENT(i);
  FOR_EACH_FUNCTION(DIFFUSE)
  int table = int(material.specular.w);
  if (table >= 0) {
    glossyResponse(table, normal, normalize(viewer.xyz - viewer.w * vPosition), response);
#define GLOSSY(i, l) exitGlossy += response[i] * COEFFICIENT(i);
    FOR_EACH_FUNCTION(GLOSSY)
  }
  colour.rgb =
      sound(material.emission.rgb + material.albedo.rgb * exitDiffuse + material.specular.rgb * exitGlossy);
}
