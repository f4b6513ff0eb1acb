#version 450 core
// Marks without vertex arrays: triangles take their corners from the list; points and edges become strips
// of the picture around them, two triangles each.
layout(std430, binding = 0) readonly buffer Places { float places[]; };

uniform mat4 worldToClip;
uniform vec2 size;     // of the picture, pixels
uniform float reach;   // pixels around a point or edge
uniform int corners;   // of a mark: 1 point, 2 edge, 3 triangle

flat out vec2 vFrom, vTo;         // ends in pixels, from the bottom left
flat out float vFromDepth, vToDepth;  // in normalised device coordinates
out float vDepth;                 // of triangles

vec4 clipOf(int place) { return worldToClip * vec4(places[3 * place], places[3 * place + 1], places[3 * place + 2], 1.0); }

void main() {
  vFrom = vTo = vec2(0.0);
  vFromDepth = vToDepth = vDepth = 0.0;
  if (corners == 3) {
    vec4 clip = clipOf(gl_VertexID);
    bool whole = true;
    for (int i = 0; i < 3; ++i) whole = whole && clipOf(gl_VertexID / 3 * 3 + i).w > 0.0;
    vDepth = clip.z / clip.w;
    // Straight on the picture, as depth is; never clipped by the near plane.
    gl_Position = whole ? vec4(clip.xy / clip.w, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  int mark = gl_VertexID / 6;
  int corner = int[6](0, 1, 2, 2, 1, 3)[gl_VertexID % 6];
  vec4 a = clipOf(corners * mark), b = clipOf(corners * mark + corners - 1);
  if (a.w <= 0.0 || b.w <= 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vFrom = (0.5 + 0.5 * a.xy / a.w) * size;
  vTo = (0.5 + 0.5 * b.xy / b.w) * size;
  vFromDepth = a.z / a.w;
  vToDepth = b.z / b.w;
  vec2 along = vTo - vFrom;
  along = length(along) > 1e-4 ? normalize(along) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  bool atEnd = corner >= 2;
  vec2 place = (atEnd ? vTo : vFrom) + (reach + 1.0) * ((atEnd ? along : -along) + (corner % 2 == 0 ? across : -across));
  gl_Position = vec4(2.0 * place / size - 1.0, 0.0, 1.0);
}
