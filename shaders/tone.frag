#version 450 core
// Radiance to the screen. Samples are averaged after the curve, so that edges against bright light stay smooth.
#include "tone.glsl"

layout(location = 0) out vec4 colour;

uniform sampler2DMS manySamples;
uniform sampler2D oneSample;
uniform int samples;
uniform vec3 behind;  // seen where nothing was drawn

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 sum = vec4(0.0);
  if (samples > 1) {
    for (int i = 0; i < samples; ++i) {
      vec4 value = texelFetch(manySamples, pixel, i);
      sum += vec4(toneMap(value.rgb), value.a);
    }
    colour = sum / float(samples);
  } else {
    vec4 value = texelFetch(oneSample, pixel, 0);
    colour = vec4(toneMap(value.rgb), value.a);
  }
  colour.rgb += (1.0 - colour.a) * behind;
}
