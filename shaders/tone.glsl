// As shade/tonemap.h: exposure in stops, a tone curve, the sRGB encoding.
uniform float exposure;
uniform int filmic;

vec3 encodeSrgb(vec3 c) {
  vec3 low = 12.92 * c;
  vec3 high = 1.055 * pow(max(c, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, low, lessThanEqual(c, vec3(0.0031308)));
}

vec3 filmicCurve(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

vec3 toneMap(vec3 radiance) {
  vec3 exposed = clamp(radiance * exp2(exposure), 0.0, 1e6);
  return encodeSrgb(clamp(filmic != 0 ? filmicCurve(exposed) : exposed, 0.0, 1.0));
}
