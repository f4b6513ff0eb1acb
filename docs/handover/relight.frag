// Exit radiance towards the eye, linear Rec.709.

in vec3 vAlbedo, vExit;
layout(location = 0) out vec4 colour;

#ifdef FULL
in vec3 vPosition, vNormal, vIncident[FUNCTIONS];
flat in int vObject;
uniform vec3 eye;
layout(std430, binding = 4) readonly buffer Specular { float specular[]; };  // [O,3]
layout(std430, binding = 5) readonly buffer Response { float weights[]; };   // [O,ROWS,BANDS lobes,BANDS]

// How much of what arrives in each function a Phong surface of specular colour 1 sends to the eye: a few
// zonal lobes in the plane of normal and view, lobe j at pi j / BANDS from the normal, with tabulated weights.
void phong(vec3 normal, vec3 view, out float response[FUNCTIONS]) {
  float along = dot(normal, view);
  vec3 across = view - along * normal;
  float sine = length(across);
  vec3 tangent = sine > 1e-6 ? across / sine : normalize(cross(normal, abs(normal.x) < 0.7 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
  float angle = atan(sine, max(along, 0.0));
  float row = float(ROWS - 1) * (1.0 - sqrt(max(0.0, 1.0 - angle / 1.57079632679)));
  int first = min(int(row), ROWS - 2);
  for (int i = 0; i < FUNCTIONS; ++i) response[i] = 0.0;
  for (int lobe = 0; lobe < BANDS; ++lobe) {
    float turn = 3.14159265359 * float(lobe) / float(BANDS), y[FUNCTIONS];
    shBasis(sin(turn) * tangent + cos(turn) * normal, y);
    for (int l = 0, i = 0; l < BANDS; ++l) {
      int at = ((vObject * ROWS + first) * BANDS + lobe) * BANDS + l;
      float weight = mix(weights[at], weights[at + BANDS * BANDS], row - float(first));
      for (; i < (l + 1) * (l + 1); ++i) response[i] += weight * y[i];
    }
  }
}
#endif

void main() {
  vec3 radiance = vAlbedo * vExit;
#ifdef FULL
  vec3 normal = normalize(vNormal);
  radiance += vAlbedo * lambert(normal, vIncident);
  vec3 gloss = vec3(specular[3 * vObject], specular[3 * vObject + 1], specular[3 * vObject + 2]);
  if (ROWS > 1 && gloss != vec3(0.0)) {
    float response[FUNCTIONS];
    phong(normal, normalize(eye - vPosition), response);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < FUNCTIONS; ++i) sum += response[i] * vIncident[i];
    radiance += gloss * sum;
  }
#endif
  // Truncated harmonics ring below zero; what is seen from behind is black.
  colour = vec4(gl_FrontFacing ? max(radiance, vec3(0.0)) : vec3(0.0), 1.0);
}
