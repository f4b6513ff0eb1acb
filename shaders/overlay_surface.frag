#version 450 core
// False colour of a value per vertex, shaded a little so that shapes stay legible; see shade/surface_overlay.h.
in vec3 vPosition, vNormal;
in float vValue, vKnown;
layout(location = 0) out vec4 colour;

uniform sampler2D scale;  // the colours of 0..1
uniform vec3 eye, axis;  // axis: towards whoever looks, where rays are parallel
uniform int parallel;
uniform vec3 unknown;

void main() {
  int last = textureSize(scale, 0).x - 1;
  float at = clamp(vValue, 0.0, 1.0) * float(last);
  int first = min(int(at), last - 1);
  vec3 c = mix(texelFetch(scale, ivec2(first, 0), 0).rgb, texelFetch(scale, ivec2(first + 1, 0), 0).rgb, at - float(first));
  if (vKnown < 0.9999) c = unknown;
  vec3 toViewer = parallel != 0 ? axis : eye - vPosition;
  float lengths = length(vNormal) * length(toViewer);
  float cosine = lengths > 0.0 ? abs(dot(vNormal, toViewer)) / lengths : 1.0;
  colour = vec4((SHADE_LEAST + (1.0 - SHADE_LEAST) * cosine) * c, 1.0);
}
