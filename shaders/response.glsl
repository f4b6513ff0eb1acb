// The BRDF's response towards the viewer as turned zonal lobes, see libprt/material/glossy_response.h: in
// band l, a lobe at a fixed angle to the normal in the viewing plane has a weight that depends on the view
// angle. A table holds RESPONSE_ROWS view angles, denser towards the horizon; a row, for each lobe, its
// weights band by band as half floats, two to a word.
const int kLobeWords = (BANDS + 1) / 2;
const int kRowWords = BANDS * kLobeWords;
layout(std430, binding = 5) readonly buffer Responses { uint responses[]; };
uniform vec2 lobes[BANDS];  // sine and cosine of each lobe's angle

#include "tangent.glsl"

void glossyResponse(int table, vec3 normal, vec3 view, out float response[kFunctions]) {
  float cosine = dot(normal, view);
  vec3 across = view - cosine * normal;
  float sine = length(across);
  vec3 tangent = sine > 1e-6 ? across / sine : someTangent(normal);
  float angle = atan(sine, clamp(cosine, 0.0, 1.0));
  float row = float(RESPONSE_ROWS - 1) * (1.0 - sqrt(max(0.0, 1.0 - angle / 1.57079632679)));
  int first = clamp(int(row), 0, RESPONSE_ROWS - 2);
  float between = row - float(first);
  int at = (table * RESPONSE_ROWS + first) * kRowWords;

#define CLEAR(i, l) response[i] = 0.0;
#define READ(w) pair = mix(unpackHalf2x16(responses[at + w]), unpackHalf2x16(responses[at + kRowWords + w]), between); weight[2 * w] = pair.x; weight[2 * w + 1] = pair.y;
#define ADD(i, l) response[i] += weight[l] * y[i];
  FOR_EACH_FUNCTION(CLEAR)
  for (int j = 0; j < BANDS; ++j, at += kLobeWords) {
    float weight[2 * kLobeWords], y[kFunctions];
    vec2 pair;
    FOR_EACH_BAND_PAIR(READ)
    shEvaluate(lobes[j].x * tangent + lobes[j].y * normal, y);
    FOR_EACH_FUNCTION(ADD)
  }
}
