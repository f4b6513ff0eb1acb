#version 450 core
// The environment behind the model.
#include "environment.glsl"

in vec2 vPlace;
layout(location = 0) out vec4 colour;

uniform sampler2D environment;
uniform float rotation;
uniform vec3 corner, right, up;  // world direction to the bottom left corner; across; upwards
uniform float intensity;
uniform int smoothTexels;

void main() {
  vec2 place = latLong(corner + vPlace.x * right + vPlace.y * up, rotation);
  ivec2 size = textureSize(environment, 0);
  ivec2 texel = clamp(ivec2(fract(place.x) * size.x, place.y * size.y), ivec2(0), size - 1);
  vec3 radiance = smoothTexels != 0 ? textureLod(environment, place, 0.0).rgb : texelFetch(environment, texel, 0).rgb;
  colour = vec4(intensity * radiance, 1.0);
}
