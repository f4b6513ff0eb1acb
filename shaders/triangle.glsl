// The triangle under this pixel, and the pixel's place in it.
layout(std430, binding = 1) readonly buffer Corners { uint corners[]; };      // three vertices per triangle
layout(std430, binding = 2) readonly buffer Positions { float positions[]; };  // three per vertex

vec3 positionOf(uint v) { return vec3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]); }

uvec3 triangle() {
  uint first = 3u * uint(gl_PrimitiveID);
  return uvec3(corners[first], corners[first + 1], corners[first + 2]);
}

// Weights of the triangle's corners 1 and 2 at a place, seen from corner 0. On an edge the place may lie outside by part of a
// pixel: the middle of a pixel of which the triangle covers another part. (No "centroid": Mesa's software driver
// bends what it interpolates that way.)
vec2 weightsOf(vec3 p, vec3 e1, vec3 e2) {
  float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2), p1 = dot(p, e1), p2 = dot(p, e2);
  float area = d11 * d22 - d12 * d12;
  return area > 0.0 ? vec2(d22 * p1 - d12 * p2, d11 * p2 - d12 * p1) / area : vec2(0.0);
}
// Those of a place inside, for all three corners.
vec3 broughtInside(vec2 w) {
  vec3 inside = max(vec3(1.0 - w.x - w.y, w), vec3(0.0));
  return inside / (inside.x + inside.y + inside.z);
}
vec3 barycentric(uvec3 t) {
  vec3 a = positionOf(t.x);
  return broughtInside(weightsOf(vPosition - a, positionOf(t.y) - a, positionOf(t.z) - a));
}

// The way to that place, in pixels; what is interpolated over the triangle is INSIDE(it, way) there. Before any
// branch: it takes derivatives, of what is interpolated alone, since pixels beside the triangle read no buffers.
vec2 wayInside(uvec3 t) {
  vec3 px = dFdx(vPosition), py = dFdy(vPosition);
  vec3 a = positionOf(t.x), e1 = positionOf(t.y) - a, e2 = positionOf(t.z) - a;
  vec2 w = weightsOf(vPosition - a, e1, e2), dx = weightsOf(px, e1, e2), dy = weightsOf(py, e1, e2);
  vec2 way = broughtInside(w).yz - w;
  float det = dx.x * dy.y - dx.y * dy.x;
  return det != 0.0 ? clamp(vec2(way.x * dy.y - way.y * dy.x, dx.x * way.y - dx.y * way.x) / det, vec2(-1.0), vec2(1.0))
                    : vec2(0.0);
}
#define INSIDE(value, way) ((value) + (way).x * dFdx(value) + (way).y * dFdy(value))
