#version 450 core
// One triangle that covers the target, at the far plane.
out vec2 vPlace;  // 0..1 over the target, from the bottom left

void main() {
  vPlace = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * vPlace - 1.0, 1.0, 1.0);
}
