#version 450 core
// The mean of several passes.
layout(location = 0) out vec4 colour;
uniform sampler2D sum;
uniform float count;

void main() { colour = texelFetch(sum, ivec2(gl_FragCoord.xy), 0) / count; }
