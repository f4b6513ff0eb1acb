#version 450 core
// Colours of triangles and squares in texture space, shaded as false colour is; see shade/surface_overlay.h.
in vec3 vPosition, vNormal;
flat in vec3 vColour;
in vec2 vSquare;
layout(location = 0) out vec4 colour;

uniform vec3 eye, axis;  // axis: towards whoever looks, where rays are parallel
uniform int parallel;
uniform int pictured;
uniform sampler2D picture;  // the first row is v = 1

void main() {
  ivec2 square = ivec2(floor(vSquare));
  vec3 c = ((square.x + square.y) & 1) != 0 ? DARK_SQUARE * vColour : vColour;
  if (pictured != 0) {
    ivec2 size = textureSize(picture, 0);
    vec2 place = vec2(vSquare.x, 1.0 - vSquare.y) * vec2(size);
    c = texelFetch(picture, clamp(ivec2(floor(place)), ivec2(0), size - 1), 0).rgb;
  }
  vec3 toViewer = parallel != 0 ? axis : eye - vPosition;
  float lengths = length(vNormal) * length(toViewer);
  float cosine = lengths > 0.0 ? abs(dot(vNormal, toViewer)) / lengths : 1.0;
  colour = vec4((SHADE_LEAST + (1.0 - SHADE_LEAST) * cosine) * c, 1.0);
}
