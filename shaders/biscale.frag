#version 450 core
// Both scales together, as shade/biscale.h: light at the triangle's corners, each in its own frame, is
// interpolated and meets the patch's response there, between the views around the viewer's.
//   FILTER  the response of all that the pixel covers
//   LAYERS  several patches one over the other, blended by weights
in vec3 vPosition;
layout(location = 0) out vec4 colour;

#include "triangle.glsl"
#include "sound.glsl"
#include "tangent.glsl"
#include "view_square.glsl"

layout(std430, binding = 0) readonly buffer PlainTexels { uint plainTexels[]; };  // per triangle; kPatched: none
layout(std430, binding = 3) readonly buffer Normals { float normals[]; };         // three per vertex
layout(std430, binding = 4) readonly buffer Tangents { float tangents[]; };       // three per corner
layout(std430, binding = 5) readonly buffer Coordinates { vec2 coordinates[]; };  // per corner, in the atlas or in patches

uniform samplerBuffer light;       // per vertex, channel and group: two times four functions
uniform usamplerBuffer responses;  // per texel, view, channel and group: eight functions as half floats
uniform usamplerBuffer plainResponses;  // of objects without a patch, three channels
uniform int plainViewSide;
uniform usampler2D ids;            // the id map, rows from the top
uniform int mapSize;               // 0: coordinates are the patch's own
uniform int side, viewSide;        // texels of the patch; views
uniform int channels, groups;      // 1 or 3; of eight functions
uniform vec3 patchColour;
uniform vec4 viewer;  // where, w = 1; or in which direction, w = 0
uniform int viewDependent;

const uint kEmpty = 65535u, kPatched = 0xffffffffu;

#ifdef LAYERS
const int kLayers = 4;
uniform usampler2D layerWeights;  // beside the id map: of the patches over the first, in 255ths

// What each patch shows of a texel of the id map.
void layersAt(ivec2 at, out float part[kLayers]) {
  uvec3 over = texelFetch(layerWeights, at, 0).rgb;
  part[0] = float(255u - over.r - over.g - over.b) / 255.0;
  for (int n = 0; n < 3; ++n) part[n + 1] = float(over[n]) / 255.0;
}
#else
const int kLayers = 1;
#endif
float layerPart[kLayers];  // of the place

vec3 normalOf(uint v) { return vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]); }
vec3 tangentOf(uint corner) { return vec3(tangents[3 * corner], tangents[3 * corner + 1], tangents[3 * corner + 2]); }

uvec2 cellOf(uvec2 id) { return min((2u * id + 1u) * uint(side) / 131070u, uvec2(side - 1)); }  // of (id + 1/2) / 65535

// The texel of the patch that is shown here; false where there is none.
bool texelHere(vec3 weight, out uint texel) {
  uint corner = 3u * uint(gl_PrimitiveID);
  vec2 place = weight.x * coordinates[corner] + weight.y * coordinates[corner + 1] + weight.z * coordinates[corner + 2];
  uvec2 cell;
  if (mapSize == 0) {
    cell = min(uvec2((place - floor(place)) * float(side)), uvec2(side - 1));
  } else {
    ivec2 at = clamp(ivec2(place.x * float(mapSize), (1.0 - place.y) * float(mapSize)), ivec2(0), ivec2(mapSize - 1));
    uvec2 id = texelFetch(ids, at, 0).xy;
    if (id.x == kEmpty) return false;
    cell = cellOf(id);
#ifdef LAYERS
    layersAt(at, layerPart);
#endif
  }
  texel = cell.y * uint(side) + cell.x;
  return true;
}

#ifdef FILTER
#include "patch_filter.glsl"
#endif

// Along the patch's +u: TangentFrames at this place.
vec3 tangentHere(vec3 weight, vec3 normal) {
  uint corner = 3u * uint(gl_PrimitiveID);
  vec3 first = tangentOf(corner);
  vec3 sum = weight.x * first + weight.y * tangentOf(corner + 1) + weight.z * tangentOf(corner + 2);
  sum -= dot(sum, normal) * normal;
  if (dot(sum, sum) > 1e-8) return normalize(sum);
  first -= dot(first, normal) * normal;
  return dot(first, first) > 1e-8 ? normalize(first) : someTangent(normal);
}

// Towards the viewer, in the patch's frame.
vec3 localView(uvec3 t, vec3 weight) {
  vec3 normal = weight.x * normalOf(t.x) + weight.y * normalOf(t.y) + weight.z * normalOf(t.z);
  normal = dot(normal, normal) > 1e-12 ? normalize(normal) : normalOf(t.x);
  vec3 tangent = tangentHere(weight, normal);
  vec3 view = normalize(viewer.xyz - viewer.w * vPosition);
  return vec3(dot(view, tangent), dot(view, cross(normal, tangent)), dot(view, normal));
}

// Adds eight functions of a texel's response, between the views around the viewer's. The table has `viewsHere`
// views a side and `channelsHere` channels.
uvec4 view;
vec4 share;
int viewsHere, channelsHere;
#define ADD(table, number, factor) \
  { \
    ivec4 block = ivec4(((number) * uint(viewsHere * viewsHere) + view) * uint(channelsHere * groups)) + at; \
    for (int i = 0; i < 4; ++i) { \
      uvec4 halfs = texelFetch(table, block[i]); \
      low += (factor) * share[i] * vec4(unpackHalf2x16(halfs.x), unpackHalf2x16(halfs.y)); \
      high += (factor) * share[i] * vec4(unpackHalf2x16(halfs.z), unpackHalf2x16(halfs.w)); \
    } \
  }

void main() {
  colour = vec4(0.0, 0.0, 0.0, 1.0);
  if (!gl_FrontFacing) return;
  uvec3 t = triangle();
  vec3 weight = barycentric(t);
  uint texel = plainTexels[gl_PrimitiveID];
  bool plain = texel != kPatched;
#ifdef FILTER
  bool filtered = !plain && filterHere(t, weight);
  if (!plain && !filtered && !texelHere(weight, texel)) return;
#else
  if (!plain && !texelHere(weight, texel)) return;
#endif
  viewsHere = plain ? plainViewSide : viewSide;
  channelsHere = plain ? 3 : channels;
  viewsAround(viewDependent != 0 || plain ? localView(t, weight) : vec3(0.0, 0.0, 1.0), viewsHere, view, share);

  ivec3 corner = ivec3(t * uint(6 * groups));
  vec3 sum = vec3(0.0);
  for (int k = 0; k < groups; ++k) {
    vec4 low, high;
    for (int c = 0; c < 3; ++c) {
      if (c < channelsHere) {
        int at = c * groups + k;
        low = high = vec4(0.0);
        if (plain)
          ADD(plainResponses, texel, 1.0)
#ifdef FILTER
        else if (filtered) {
          for (int e = 0; e < exactCount; ++e) ADD(responses, exactTexel[e], exactWeight[e])
          if (coarseToo)
            for (int e = 0; e < termCount; ++e) ADD(terms, uint(e), coefficient[e])
        }
#endif
        else
#ifdef LAYERS
          for (int n = 0; n < kLayers; ++n)
            if (layerPart[n] > 0.0)
              ADD(responses, texel + uint(n * side * side), layerPart[n])
#else
          ADD(responses, texel, 1.0)
#endif
      }
      ivec3 at = corner + 2 * (c * groups + k);
      vec4 lightLow = weight.x * texelFetch(light, at.x) + weight.y * texelFetch(light, at.y) + weight.z * texelFetch(light, at.z);
      at += 1;
      vec4 lightHigh = weight.x * texelFetch(light, at.x) + weight.y * texelFetch(light, at.y) + weight.z * texelFetch(light, at.z);
      sum[c] += dot(low, lightLow) + dot(high, lightHigh);
    }
  }
  colour.rgb = sound((plain ? vec3(1.0) : patchColour) * sum);
}
