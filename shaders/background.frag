#version 450 core
// The sky behind the model: environment map, circle lights, constant light.
#include "environment.glsl"

struct Circle {
  vec4 axis;      // and 1 - cosine of the rim
  vec4 radiance;  // and sine of the rim
};

in vec2 vPlace;
layout(location = 0) out vec4 colour;

layout(std430, binding = 6) readonly buffer Circles { Circle circles[]; };

uniform sampler2D environment;
uniform float rotation;
uniform vec3 corner, right, up;  // world direction to the bottom left corner; across; upwards
uniform float intensity;
uniform vec3 constant;
uniform int circleCount;
uniform float pixel;  // length across one pixel, where `right` is across all
uniform int smoothTexels;

// The part of the pixel that the disc covers, or whether its centre lies in the disc.
float coverage(Circle circle, vec3 direction, float pixelAngle) {
  vec3 chord = direction - circle.axis.xyz;
  float inside = circle.axis.w - 0.5 * dot(chord, chord);
  return smoothTexels != 0 ? clamp(inside / (circle.radiance.w * pixelAngle) + 0.5, 0.0, 1.0) : float(inside >= 0.0);
}

void main() {
  vec3 direction = corner + vPlace.x * right + vPlace.y * up;
  vec2 place = latLong(direction, rotation);
  ivec2 size = textureSize(environment, 0);
  ivec2 texel = clamp(ivec2(fract(place.x) * size.x, place.y * size.y), ivec2(0), size - 1);
  vec3 radiance = smoothTexels != 0 ? textureLod(environment, place, 0.0).rgb : texelFetch(environment, texel, 0).rgb;
  radiance = intensity * radiance + constant;
  for (int i = 0; i < circleCount; ++i)
    radiance += circles[i].radiance.rgb * coverage(circles[i], normalize(direction), pixel / length(direction));
  colour = vec4(radiance, 1.0);
}
