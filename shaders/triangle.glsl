// The triangle under this pixel, and the pixel's place in it.
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };      // three vertices per triangle
layout(std430, binding = 2) readonly buffer Positions { float positions[]; };  // three per vertex

vec3 positionOf(uint v) { return vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]); }

uvec3 triangle() {
  uint first = 3u * uint(gl_PrimitiveID);
  return uvec3(corners[first], corners[first + 1], corners[first + 2]);
}

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
