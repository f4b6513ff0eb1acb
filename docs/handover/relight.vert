// Light meets transfer at the vertex. With FULL the whole transferred radiance goes on to the pixel.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float vertex;  // row of the arrays, attribute _VERTEX

layout(std430, binding = 0) readonly buffer Albedo { float albedo[]; };                   // [V,3]
layout(std430, binding = 1) readonly buffer TransferDiffuse { float transferDiffuse[]; };  // [V,k] or [V,k,3]
uniform vec3 light[FUNCTIONS];
uniform mat4 worldToClip;

out vec3 vAlbedo, vExit;

#define NUMBER(array, channels, at) \
  (channels == 3 ? vec3(array[3 * (at)], array[3 * (at) + 1], array[3 * (at) + 2]) : vec3(array[at]))

#ifdef FULL
layout(std430, binding = 2) readonly buffer Transfer { float transfer[]; };  // [V,k,k] or [V,k,k,3]
layout(std430, binding = 3) readonly buffer Object { int object[]; };        // [V]
out vec3 vPosition, vNormal, vIncident[FUNCTIONS];
flat out int vObject;
#endif

void main() {
  int v = int(vertex);
  gl_Position = worldToClip * vec4(position, 1.0);
  vAlbedo = vec3(albedo[3 * v], albedo[3 * v + 1], albedo[3 * v + 2]);

  // What a white diffuse surface sends out here: one dot product.
  vExit = vec3(0.0);
  for (int i = 0; i < FUNCTIONS; ++i) vExit += NUMBER(transferDiffuse, DIFFUSE_CHANNELS, v * FUNCTIONS + i) * light[i];

#ifdef FULL
  vPosition = position;
  vNormal = normal;
  vObject = object[v];
  // What arrives here, shadows and bounces included: matrix times light, in the object frame.
  for (int i = 0; i < FUNCTIONS; ++i) {
    vIncident[i] = vec3(0.0);
    for (int j = 0; j < FUNCTIONS; ++j)
      vIncident[i] += NUMBER(transfer, TRANSFER_CHANNELS, (v * FUNCTIONS + i) * FUNCTIONS + j) * light[j];
  }
  // The pixel adds the diffuse part of it for its own normal; here remains what few bands cannot hold.
  vExit -= lambert(normalize(normal), vIncident);
#endif
}
