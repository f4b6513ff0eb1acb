// As shade/patch_filter.h: all that a pixel covers of the patch, as exact texels of level 0 and as
// coefficients of the coarser levels.
#include "footprint.glsl"

layout(std430, binding = 6) readonly buffer Rectangles { int rectangles[]; };  // first, x, y, width, height
layout(std430, binding = 7) readonly buffer Charts { uint charts[]; };         // per triangle

uniform usamplerBuffer coefficients;  // per texel, eight half floats twice
uniform usamplerBuffer terms;         // E_t, as the responses of texels
uniform usampler2D owners;            // the chart of the id map's texels, and 1
uniform int levels, termCount;  // kTerms, as a number that compilers do not unroll loops by
uniform vec2 scales[16];
const int kTerms = 16;
const float kSharper = 0.6;

uint exactTexel[4 * kLayers * kMostTaps];
float exactWeight[4 * kLayers * kMostTaps];
int exactCount = 0;
float coefficient[kTerms];
bool coarseToo = false;

int wrapped(int x, int n) { return x - n * int(floor(float(x) / float(n))); }

vec2 placeOf(vec2 coordinates) {
  return mapSize > 0 ? float(mapSize) * vec2(coordinates.x, 1.0 - coordinates.y) : float(side) * coordinates;
}

// Texels of level 0 around a place that belong to the chart; false where there are none.
vec4 partAround[kLayers];  // what each patch shows of the four
bool texelsAround(vec2 place, uint chart, out uvec4 texel, out vec4 weight) {
  vec2 p = place - 0.5, low = floor(p), part = p - low;
  weight = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
  for (int i = 0; i < 4; ++i) {
    ivec2 at = ivec2(low) + ivec2(i & 1, i >> 1);
    uvec2 cell = uvec2(0u);
    if (mapSize == 0) {
      cell = uvec2(wrapped(at.x, side), wrapped(at.y, side));
    } else if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(mapSize))) ||
               texelFetch(owners, at, 0).x != ((chart + 1u) & 0xffffu)) {
      weight[i] = 0.0;
    } else {
      cell = cellOf(texelFetch(ids, at, 0).xy);
#ifdef LAYERS
      float part[kLayers];
      layersAt(at, part);
      for (int n = 0; n < kLayers; ++n) partAround[n][i] = part[n];
#endif
    }
    texel[i] = cell.y * uint(side) + cell.x;
  }
  float sum = weight.x + weight.y + weight.z + weight.w;
  if (sum > 0.0) weight /= sum;
  return sum > 0.0;
}

void addLevel(vec2 place, uint chart, int level, float weight) {
  int at = 5 * (int(chart) * levels + level - 1);
  int width = rectangles[at + 3], height = rectangles[at + 4];
  vec2 p = place * scales[level] - vec2(rectangles[at + 1], rectangles[at + 2]) - 0.5, low = floor(p), part = p - low;
  for (int i = 0; i < 4; ++i) {
    ivec2 cell = ivec2(low) + ivec2(i & 1, i >> 1);
    cell = mapSize == 0 ? ivec2(wrapped(cell.x, width), wrapped(cell.y, height)) : clamp(cell, ivec2(0), ivec2(width, height) - 1);
    float share = weight * ((i & 1) != 0 ? part.x : 1.0 - part.x) * ((i >> 1) != 0 ? part.y : 1.0 - part.y);
    int from = 2 * (rectangles[at] + cell.y * width + cell.x);
    for (int g = 0; g < 2; ++g) {
      uvec4 halfs = texelFetch(coefficients, from + g);
      for (int j = 0; j < 4; ++j) {
        vec2 pair = share * unpackHalf2x16(halfs[j]);
        coefficient[8 * g + 2 * j] += pair.x;
        coefficient[8 * g + 2 * j + 1] += pair.y;
      }
    }
  }
}

void addLevels(vec2 place, uint chart, float level, float weight) {
  float at = clamp(level, 1.0, float(levels));
  int below = min(int(at), max(1, levels - 1));
  float between = at - float(below);
  if (between < 1.0) addLevel(place, chart, below, weight * (1.0 - between));
  if (between > 0.0) addLevel(place, chart, below + 1, weight * between);
}

// Fills the lists above; false where nothing can be told.
bool filterHere(uvec3 t, vec3 weight) {
  uint corner = 3u * uint(gl_PrimitiveID), chart = charts[gl_PrimitiveID];
  vec2 c0 = placeOf(coordinates[corner]), c1 = placeOf(coordinates[corner + 1]), c2 = placeOf(coordinates[corner + 2]);
  vec2 middle = weight.x * c0 + weight.y * c1 + weight.z * c2;
  vec3 a = positionOf(t.x), e1 = positionOf(t.y) - a, e2 = positionOf(t.z) - a, right, down;
  planeSteps(vPosition, viewer, e1, e2, right, down);
  vec2 r = weightsOf(right, e1, e2), d = weightsOf(down, e1, e2), step;
  int taps;
  float width;
  footprintOf(r.x * (c1 - c0) + r.y * (c2 - c0), d.x * (c1 - c0) + d.y * (c2 - c0), taps, width, step);

  bool holds = rectangles[5 * int(chart) * levels + 3] > 0;
  float level = holds ? clamp(log2(max(kSharper * width, 1e-20)), 0.0, float(levels)) : 0.0;
  uvec4 here;
  vec4 hereWeight;
  bool known = texelsAround(middle, chart, here, hereWeight);
#ifdef LAYERS
  vec4 herePart[kLayers] = partAround;
#endif
  float coarse = !known && level > 0.0 ? 1.0 : min(level, 1.0), part = 1.0 / float(taps);
  if (coarse == 0.0 && !known) return false;
  for (int k = 0; k < termCount; ++k) coefficient[k] = 0.0;
  coarseToo = coarse > 0.0;
  for (int i = 0; i < taps; ++i) {
    vec2 place = middle + (float(i) - 0.5 * float(taps - 1)) * step;
    if (coarse < 1.0) {
      uvec4 texel;
      vec4 share;
      if (!texelsAround(place, chart, texel, share)) {
        texel = here, share = hereWeight;
#ifdef LAYERS
        partAround = herePart;
#endif
      }
      for (int k = 0; k < 4; ++k)
        for (int n = 0; n < kLayers; ++n) {
#ifdef LAYERS
          float weight = share[k] * partAround[n][k];
#else
          float weight = share[k];
#endif
          if (weight > 0.0) {
            exactTexel[exactCount] = texel[k] + uint(n * side * side);
            exactWeight[exactCount] = weight * part * (1.0 - coarse);
            ++exactCount;
          }
        }
    }
    if (coarseToo) addLevels(place, chart, level, part * coarse);
  }
  return true;
}
