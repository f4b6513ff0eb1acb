// Where a direction falls on a lat-long map: the top row looks to +Y, the centre column to -Z, u grows
// towards +X. A positive rotation turns the light counter-clockwise seen from +Y.
const float kPi = 3.14159265358979;

vec2 latLong(vec3 direction, float rotation) {
  vec3 d = normalize(direction);
  float azimuth = atan(d.x, -d.z) + rotation;
  return vec2(0.5 + azimuth / (2.0 * kPi), acos(clamp(d.y, -1.0, 1.0)) / kPi);
}
