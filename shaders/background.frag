#version 450 core
// The environment behind the model.
#include "environment.glsl"

in vec2 vPlace;
layout(location = 0) out vec4 colour;

uniform sampler2D environment;
uniform float rotation;
uniform vec3 corner, right, up;  // world direction to the bottom left corner; across; upwards
uniform float alpha;

void main() {
  vec3 direction = corner + vPlace.x * right + vPlace.y * up;
  colour = vec4(textureLod(environment, latLong(direction, rotation), 0.0).rgb, alpha);
}
