// Any direction across the normal will do where nothing tells one.
vec3 someTangent(vec3 n) {
  float sign = n.z < 0.0 ? -1.0 : 1.0;
  float a = -1.0 / (sign + n.z);
  return vec3(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}
