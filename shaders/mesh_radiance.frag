#version 450 core
// Surfaces lit by transferred radiance: coefficients interpolated over the triangle meet the response of
// the material, to the pixel's own normal and view.
//   INTERPOLATED  coefficients arrive interpolated
//   EVERYWHERE    the same light at every vertex
//   otherwise     they are fetched at the triangle's corners: for back sides, and for more bands than fit
//                 between the stages
#include "mesh.glsl"
#include "radiance.glsl"
#include "response.glsl"

layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };      // three vertices per triangle
layout(std430, binding = 2) readonly buffer Positions { float positions[]; };  // three per vertex
layout(std430, binding = 4) readonly buffer Behind { uint behind[]; };         // sample on the vertex's back

in vec3 vFront, vBehind;  // reflected beyond what the coefficients hold
uniform vec4 viewer;  // where, w = 1; or in which direction, w = 0

const uint kNone = 0xffffffffu;

vec3 positionOf(uint v) { return vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]); }

#if defined(INTERPOLATED)
in vec4 vLight[kLightSlots];
#define NUMBER(n) vLight[(n) / 4][(n) % 4]
#define COEFFICIENT(i) vec3(NUMBER(3 * i), NUMBER(3 * i + 1), NUMBER(3 * i + 2))
#elif defined(EVERYWHERE)
uniform vec3 light[kFunctions];
#define COEFFICIENT(i) light[i]
#else
// Weights of the triangle's corners at this place. On an edge the place may lie outside by part of a pixel.
// (No "centroid": Mesa's software driver bends what it interpolates that way.)
vec3 barycentric(uvec3 t) {
  vec3 a = positionOf(t.x), e1 = positionOf(t.y) - a, e2 = positionOf(t.z) - a, p = vPosition - a;
  float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), p1 = dot(p, e1), p2 = dot(p, e2);
  float area = d11 * d22 - d12 * d12;
  vec2 w = area > 0.0 ? vec2(d22 * p1 - d12 * p2, d11 * p2 - d12 * p1) / area : vec2(0.0);
  vec3 inside = max(vec3(1.0 - w.x - w.y, w), vec3(0.0));
  return inside / (inside.x + inside.y + inside.z);
}
vec3 fetch(uint at) { return vec3(radiance[at], radiance[at + 1], radiance[at + 2]); }
#define COEFFICIENT(i) (weight.x * fetch(at.x + 3 * i) + weight.y * fetch(at.y + 3 * i) + weight.z * fetch(at.z + 3 * i))
#endif

// The triangle under this pixel.
uvec3 triangle() {
  uint first = 3u * uint(gl_PrimitiveID);
  return uvec3(corners[first], corners[first + 1], corners[first + 2]);
}

// Unit normal on the side that is seen; the face's own where the shading normals cancel.
vec3 seenNormal() {
  vec3 normal = vNormal;
  if (dot(normal, normal) < 1e-12) {
    uvec3 t = triangle();
    normal = cross(positionOf(t.y) - positionOf(t.x), positionOf(t.z) - positionOf(t.x));
  }
  return (gl_FrontFacing ? 1.0 : -1.0) * normalize(normal);
}

void main() {
  Material material = materials[vObject];
  colour = vec4(0.0, 0.0, 0.0, 1.0);
  if (!gl_FrontFacing && material.albedo.w == 0.0) return;
#if !defined(INTERPOLATED) && !defined(EVERYWHERE)
  uvec3 t = triangle();
  uvec3 at = gl_FrontFacing ? t : uvec3(behind[t.x], behind[t.y], behind[t.z]);
  if (at.x == kNone || at.y == kNone || at.z == kNone) return;
  vec3 weight = barycentric(t);
  at *= 3u * uint(kFunctions);
#endif

  vec3 normal = seenNormal(), exitDiffuse = gl_FrontFacing ? vFront : vBehind, exitGlossy = vec3(0.0);
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
  colour.rgb = sound(material.albedo.rgb * exitDiffuse + material.specular.rgb * exitGlossy);
}
