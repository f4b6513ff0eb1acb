// As shade/footprint.h: what a pixel covers of a texture.
uniform vec3 forward, pixelRight, pixelDown;
const int kMostTaps = 8;

// How the place on the plane of two edges moves from pixel to pixel.
void planeSteps(vec3 p, vec4 viewer, vec3 e1, vec3 e2, out vec3 right, out vec3 down) {
  vec3 normal = cross(e1, e2);
  vec3 ray = viewer.w > 0.0 ? p - viewer.xyz : forward;
  float distance = viewer.w > 0.0 ? dot(ray, forward) : 1.0;
  float across = dot(ray, normal), least = 1e-3 * length(ray) * length(normal);
  right = down = vec3(0.0);
  if (!(least > 0.0)) return;
  float slope = across < 0.0 ? min(across, -least) : max(across, least);
  right = distance * pixelRight;
  down = distance * pixelDown;
  right -= ray * (dot(right, normal) / slope);
  down -= ray * (dot(down, normal) / slope);
}

void footprintOf(vec2 right, vec2 down, out int taps, out float width, out vec2 step) {
  float a = right.x * right.x + down.x * down.x, b = right.x * right.y + down.x * down.y, c = right.y * right.y + down.y * down.y;
  float mean = 0.5 * (a + c), half_ = 0.5 * (a - c), root = sqrt(half_ * half_ + b * b);
  float longest = sqrt(mean + root), shortest = sqrt(max(0.0, mean - root));
  taps = 1;
  width = 0.0;
  step = vec2(0.0);
  if (!(longest > 0.0)) return;
  taps = int(clamp(ceil(longest / max(shortest, 1e-3 * longest) - 0.5), 1.0, float(kMostTaps)));
  width = max(shortest, longest / float(taps));
  vec2 along = half_ > 0.0 ? vec2(half_ + root, b) : vec2(b, root - half_);
  float size = length(along);
  if (taps > 1 && size > 0.0) step = along * (longest / (float(taps) * size));
}
