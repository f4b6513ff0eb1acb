#version 450 core
// How much of a pixel a mark and its dark rim cover; the strongest mark counts (the blend takes the maximum).
flat in vec2 vFrom, vTo;
flat in float vFromDepth, vToDepth;
in float vDepth;
layout(location = 0) out vec4 cover;  // mark, rim

uniform sampler2D surfaceDepth;
uniform sampler2DMS surfaceDepths;
uniform int samples;
uniform int corners;
uniform float halfWidth, reach;  // pixels
uniform float fill, hidden;
uniform float lift, slack;  // how far behind the surface still counts as on it: share of its distance, and length
uniform vec3 depthTerms;  // of the projection: [2][2], [3][2], [2][3]

// Distance along the optical axis from a depth in normalised device coordinates.
float distanceAt(float z) {
  return depthTerms.z != 0.0 ? depthTerms.y / (z + depthTerms.x) : (depthTerms.y - z) / depthTerms.x;
}

float surfaceAt(ivec2 pixel) {
  if (samples == 1) return texelFetch(surfaceDepth, pixel, 0).r;
  float nearest = 1.0;
  for (int i = 0; i < samples; ++i) nearest = min(nearest, texelFetch(surfaceDepths, pixel, i).r);
  return nearest;
}

void main() {
  float t = 0.0, away = 0.0, depth = vDepth;
  if (corners < 3) {
    vec2 along = vTo - vFrom, from = gl_FragCoord.xy - vFrom;
    float square = dot(along, along);
    t = square > 0.0 ? clamp(dot(from, along) / square, 0.0, 1.0) : 0.0;
    away = length(from - t * along);
    depth = mix(vFromDepth, vToDepth, t);
  }
  float surface = surfaceAt(ivec2(gl_FragCoord.xy));
  bool seen = surface >= 1.0 || distanceAt(depth) <= (1.0 + lift) * distanceAt(2.0 * surface - 1.0) + slack;
  float opacity = seen ? 1.0 : hidden;
  if (corners == 3) cover = vec4(fill * opacity, 0.0, 0.0, 1.0);
  else cover = vec4(opacity * clamp(halfWidth - away + 0.5, 0.0, 1.0), opacity * clamp(reach - away + 0.5, 0.0, 1.0), 0.0, 1.0);
}
