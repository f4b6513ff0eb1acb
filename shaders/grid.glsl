// As shade/ground_grid.h.
uniform float gridSpacing;  // 0: no grid
uniform int gridParallel;
uniform vec3 gridOrigin[3], gridDirection[3];  // of the ray through the top left corner; from pixel to pixel right; and down

float gridNear(float distance, float footprint) { return clamp(1.0 - distance / footprint, 0.0, 1.0); }

float gridLine(float p, float footprint, float spacing) {
  float distance = abs(p - spacing * round(p / spacing));
  return gridNear(distance, footprint) * clamp(1.5 - 5.0 * footprint / spacing, 0.0, 1.0);
}

// `over` with the grid at a pixel's place, from the top left.
vec3 withGrid(vec2 at, vec3 over) {
  if (gridSpacing <= 0.0) return over;
  vec3 o = gridOrigin[0] + at.x * gridOrigin[1] + at.y * gridOrigin[2];
  vec3 d = gridDirection[0] + at.x * gridDirection[1] + at.y * gridDirection[2];
  float t = -o.y / d.y;
  if (!(gridParallel != 0 || t > 0.0) || !(abs(t) < 1e18)) return over;
  vec3 right = gridOrigin[1] + t * gridDirection[1], down = gridOrigin[2] + t * gridDirection[2];
  right -= right.y / d.y * d;
  down -= down.y / d.y * d;
  vec3 p = o + t * d;
  vec2 w = abs(right.xz) + abs(down.xz);
  if (!(w.x > 0.0 && w.y > 0.0)) return over;
  float minor = max(gridLine(p.x, w.x, gridSpacing), gridLine(p.z, w.y, gridSpacing));
  float major = max(gridLine(p.x, w.x, 10.0 * gridSpacing), gridLine(p.z, w.y, 10.0 * gridSpacing));
  float fade = clamp(1.5 - 0.5 * max(w.x, w.y) / gridSpacing, 0.0, 1.0);
  vec3 colour = mix(over, vec3(0.55), max(0.25 * minor, 0.5 * major));
  colour = mix(colour, vec3(0.85, 0.37, 0.37), 0.8 * fade * gridNear(abs(p.z), w.y));
  return mix(colour, vec3(0.37, 0.56, 0.85), 0.8 * fade * gridNear(abs(p.x), w.x));
}
