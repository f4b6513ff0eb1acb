#version 450 core
// False colour and marks, premultiplied, to be laid over the picture.
layout(location = 0) out vec4 colour;

uniform sampler2D surface;
uniform sampler2DMS surfaces;
uniform sampler2D marks;
uniform int samples;
uniform int showSurface;
uniform vec3 markColour;

const float kRimOpacity = 0.6;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 under = vec4(0.0);
  if (showSurface != 0) {
    if (samples == 1) under = texelFetch(surface, pixel, 0);
    else {
      for (int i = 0; i < samples; ++i) under += texelFetch(surfaces, pixel, i);
      under /= float(samples);
    }
  }
  vec2 cover = texelFetch(marks, pixel, 0).rg;
  float alpha = max(cover.r, kRimOpacity * cover.g);
  colour = vec4(cover.r * markColour, alpha) + (1.0 - alpha) * under;
}
