#version 450 core
// Radiance to the screen. Samples are averaged after the curve, so that edges against bright light stay smooth. Where
// nothing stands before the background, the ground grid lies over it.
#include "tone.glsl"
#include "grid.glsl"

layout(location = 0) out vec4 colour;

uniform sampler2DMS manySamples, manyDepths;
uniform sampler2D oneSample, oneDepth;
uniform int samples;
uniform vec3 behind;  // seen where nothing was drawn
uniform vec2 place;   // of gl_FragCoord's origin: x, and the height that y counts down from

vec4 shown(vec4 radiance) { return vec4(toneMap(radiance.rgb) + (1.0 - radiance.a) * behind, radiance.a); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 sum = vec4(0.0), open = vec4(0.0);  // of all samples; of those that see the background
  float opened = 0.0;
  for (int i = 0; i < samples; ++i) {
    vec4 value = shown(samples > 1 ? texelFetch(manySamples, pixel, i) : texelFetch(oneSample, pixel, 0));
    sum += value;
    if (gridSpacing <= 0.0) continue;
    float depth = samples > 1 ? texelFetch(manyDepths, pixel, i).r : texelFetch(oneDepth, pixel, 0).r;
    if (depth < 1.0) continue;
    open += value;
    opened += 1.0;
  }
  if (opened > 0.0) sum.rgb += opened * withGrid(vec2(place.x + gl_FragCoord.x, place.y - gl_FragCoord.y), open.rgb / opened) - open.rgb;
  colour = sum / float(samples);
}
