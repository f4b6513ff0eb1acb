// Spherical harmonics as in light.cpp: real, orthonormal, index l(l+1)+m, Y(1,-1..1) ~ (y, z, x).

void shBasis(vec3 d, out float y[FUNCTIONS]) {
  float diagonal = 0.28209479177, c = 1.0, s = 0.0;
  for (int m = 0; m < BANDS; ++m) {
    float before = 0.0, now = diagonal * (m > 0 ? 1.41421356237 : 1.0);
    for (int l = m; l < BANDS; ++l) {
      y[l * (l + 1) + m] = now * c;
      if (m > 0) y[l * (l + 1) - m] = now * s;
      float up = sqrt(float(4 * (l + 1) * (l + 1) - 1) / float((l + 1) * (l + 1) - m * m));
      float down = l > m ? sqrt(float(l * l - m * m) / float(4 * l * l - 1)) : 0.0;
      float next = up * (d.z * now - down * before);
      before = now;
      now = next;
    }
    diagonal *= sqrt(float(2 * m + 3) / float(2 * m + 2));
    float turned = c * d.x - s * d.y;
    s = c * d.y + s * d.x;
    c = turned;
  }
}

// What the cosine leaves of band l, over pi: 1, 2/3, 1/4, 0, -1/24, 0, 1/64 ...
float cosine(int l) {
  if (l == 1) return 2.0 / 3.0;
  if (l % 2 == 1) return 0.0;
  float factor = 1.0;
  for (int i = 2; i <= l; i += 2) factor *= float(3 - i) / float(i + 2);
  return factor;
}

// What a white diffuse surface sends out under arriving radiance.
vec3 lambert(vec3 normal, vec3 incident[FUNCTIONS]) {
  float y[FUNCTIONS];
  shBasis(normal, y);
  vec3 sum = vec3(0.0);
  for (int l = 0, i = 0; l < BANDS; ++l)
    for (; i < (l + 1) * (l + 1); ++i) sum += cosine(l) * y[i] * incident[i];
  return sum;
}
