// Exposure in stops, then the sRGB curve; what is brighter than white clips.
uniform float exposure;

vec3 encodeSrgb(vec3 c) {
  vec3 low = 12.92 * c;
  vec3 high = 1.055 * pow(max(c, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, low, lessThanEqual(c, vec3(0.0031308)));
}

vec3 toneMap(vec3 radiance) { return encodeSrgb(clamp(radiance * exp2(exposure), 0.0, 1.0)); }
