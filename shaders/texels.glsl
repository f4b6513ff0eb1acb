// The four texels around this pixel and their bilinear weights: TexelGrid::at() of atlas/chart_texels.h.
layout(std430, binding = 7) readonly buffer Colours { float colours[]; };  // three per sample
// Eight numbers per triangle, as TexelTriangle has them, and from texelStart on the charts' rectangles.
layout(std430, binding = 8) readonly buffer Texels { uint texels[]; };
uniform int texelStart;

const uint kTexelNumber = 0x7fffffffu;  // without the mark of those that are far from the chart

void texelsAround(vec3 weight, out uvec4 texel, out vec4 share) {
  uint t = 8u * uint(gl_PrimitiveID);
  vec4 places = uintBitsToFloat(uvec4(texels[t], texels[t + 1], texels[t + 2], texels[t + 3]));
  vec2 edge2 = uintBitsToFloat(uvec2(texels[t + 4], texels[t + 5]));
  uint width = texels[t + 7] & 0xffffu, height = texels[t + 7] >> 16;
  vec2 p = places.xy + weight.y * places.zw + weight.z * edge2;
  vec2 cell = clamp(floor(p), vec2(0.0), vec2(float(width) - 2.0, float(height) - 2.0));
  vec2 part = clamp(p - cell, vec2(0.0), vec2(1.0));
  uint at = uint(texelStart) + texels[t + 6] + uint(cell.y) * width + uint(cell.x);
  texel = uvec4(texels[at], texels[at + 1], texels[at + width], texels[at + width + 1]) & kTexelNumber;
  share = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
}

vec3 colourOf(uint s) { return vec3(colours[3 * s], colours[3 * s + 1], colours[3 * s + 2]); }
vec3 colourAround(uvec4 s, vec4 share) {
  return share.x * colourOf(s.x) + share.y * colourOf(s.y) + share.z * colourOf(s.z) + share.w * colourOf(s.w);
}
