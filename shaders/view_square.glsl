// As basis/view_square.h: the upper hemisphere on a square, Shirley and Chiu's map.
vec2 squareFromView(vec3 d) {
  vec2 flat_ = d.xy;
  if (d.z < 0.0) flat_ /= max(length(flat_), 1e-20);
  flat_ /= sqrt(1.0 + max(0.0, d.z));
  bool wide = abs(flat_.x) > abs(flat_.y);
  float major = wide ? flat_.x : flat_.y, minor = wide ? flat_.y : flat_.x;
  float radius = major < 0.0 ? -length(flat_) : length(flat_);
  float other = major != 0.0 ? radius * atan(minor / major) * 1.2732395447 : 0.0;
  return clamp(0.5 * (wide ? vec2(radius, other) : vec2(other, radius)) + 0.5, vec2(0.0), vec2(1.0));
}

// The four cells of a table of side x side views around a direction, and their weights.
void viewsAround(vec3 d, int side, out uvec4 view, out vec4 weight) {
  vec2 p = clamp(squareFromView(d) * float(side) - 0.5, vec2(0.0), vec2(float(side - 1)));
  int x = min(int(p.x), max(0, side - 2)), y = min(int(p.y), max(0, side - 2));
  int right = min(x + 1, side - 1), up = min(y + 1, side - 1);
  vec2 f = p - vec2(x, y);
  view = uvec4(y * side + x, y * side + right, up * side + x, up * side + right);
  weight = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
}
