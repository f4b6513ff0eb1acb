#version 450 core
// The surface by corners, so that each triangle has a colour and texture coordinates of its own.
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Normals { float normals[]; };
layout(std430, binding = 2) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 3) readonly buffer Colours { float colours[]; };  // of triangles
layout(std430, binding = 4) readonly buffer Coordinates { vec2 coordinates[]; };  // of corners

uniform mat4 worldToClip;
uniform float squares;
uniform int pictured;  // a picture takes the place of colours; squares = 1 then

out vec3 vPosition, vNormal;
flat out vec3 vColour;
out vec2 vSquare;

void main() {
  uint vertex = 3u * corners[gl_VertexID];
  vPosition = vec3(positions[vertex], positions[vertex + 1u], positions[vertex + 2u]);
  vNormal = vec3(normals[vertex], normals[vertex + 1u], normals[vertex + 2u]);
  int triangle = gl_VertexID / 3 * 3;
  vColour = pictured != 0 ? vec3(0.0) : vec3(colours[triangle], colours[triangle + 1], colours[triangle + 2]);
  vSquare = squares > 0.0 ? squares * coordinates[gl_VertexID] : vec2(0.0);
  gl_Position = worldToClip * vec4(vPosition, 1.0);
}
