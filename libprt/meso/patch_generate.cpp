#include "libprt/meso/patch_generate.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// A 2D random process: noise of several scales, flattened where the trowel went.
float stucco(const Vec2& uv, int count, std::uint32_t seed) {
  float sum = 0, weight = 1;
  for (int octave = 0; octave < 4; ++octave, weight *= 0.5f)
    sum += weight * periodicNoise(uv, count << octave, seed + std::uint32_t(octave));
  return smooth(-0.7f, 0.6f, sum);
}

/// Round holes in a plate, every second row moved by half a hole.
float holes(const Vec2& uv, int count, std::uint32_t) {
  float nearest = 1e9f;
  const float row = std::floor(uv.y * float(count));
  for (int j = -1; j <= 1; ++j) {
    const float y = row + float(j), move = count % 2 == 0 && std::fmod(y + 2, 2.0f) >= 1 ? 0.5f : 0.0f;
    const float dy = uv.y * float(count) - (y + 0.5f);
    float dx = uv.x * float(count) - 0.5f - move;
    dx -= std::round(dx);
    nearest = std::min(nearest, std::sqrt(dx * dx + dy * dy));
  }
  return smooth(0.30f, 0.38f, nearest);
}

/// Square bins between walls.
float bins(const Vec2& uv, int count, std::uint32_t) {
  const Vec2 cell = uv * float(count), in = abs(cell - floor(cell) - 0.5f);
  return smooth(0.34f, 0.41f, std::max(in.x, in.y));
}

/// Fish scales: discs in rows, each raised towards its free edge, which lies on the row below.
float scales(const Vec2& uv, int count, std::uint32_t) {
  const int rows = 2 * ((count + 1) / 2);
  const float place = uv.y * float(rows), radius = 1.05f;  // in rows
  float top = 0;
  for (int j = int(std::floor(place)) - 2; j <= int(std::floor(place)) + 2; ++j) {
    const float dy = place - float(j);
    float dx = uv.x * float(count) - (((j % 2) + 2) % 2 ? 0.5f : 0.0f);
    dx = (dx - std::round(dx)) * 1.55f;
    const float away = std::sqrt(dx * dx + dy * dy) / radius;
    if (away < 1)  // domed, tilted towards -v, with a rounded rim
      top = std::max(top,
                     (0.55f - 0.45f * dy / radius - 0.15f * dx * dx) * std::sqrt(1 - std::pow(away, 8.0f)));
  }
  return top;
}

/// Sand ripples with wandering crests.
float ripples(const Vec2& uv, int count, std::uint32_t seed) {
  const float wander = 0.35f * std::sin(2 * kPiF * uv.x + 0.7f) + 0.5f * periodicNoise(uv, 3, seed);
  const float phase = 2 * kPiF * (float(count) * uv.y + wander);
  return 0.5f + 0.5f * std::sin(phase + 0.5f * std::sin(phase));
}

struct Generator {
  const char* name;
  float (*height)(const Vec2&, int count, std::uint32_t seed);
  int count;
};

constexpr Generator kGenerators[] = {{"bins", bins, 4},
                                     {"holes", holes, 4},
                                     {"ripples", ripples, 5},
                                     {"scales", scales, 5},
                                     {"stucco", stucco, 5}};

void requireRange(const char* path, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw ValueError("is out of range", path,
                     "use " + std::to_string(int(low)) + " to " + std::to_string(int(high)));
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

Rgb flowerColour(const Vec2& uv) {
  const Rgb ground(0.10f, 0.22f, 0.05f), petal(0.80f, 0.16f, 0.30f), pale(0.90f, 0.62f, 0.55f),
      heart(0.85f, 0.60f, 0.08f);
  const Vec2 p = 2.0f * (uv - 0.5f);
  const float r = length(p), angle = std::atan2(p.y, p.x);
  const float leaf = 0.80f + 0.08f * periodicNoise(uv, 8, 3);
  const float edge = leaf * (0.62f + 0.38f * std::abs(std::cos(2.5f * angle)));
  Rgb colour = ground * (1 + 0.5f * periodicNoise(uv, 12, 5));
  const float veins = 0.5f + 0.5f * std::cos(40 * angle);
  const Rgb inside = mix(pale, petal, smooth(0.15f, 0.75f, r)) * (0.9f + 0.1f * veins);
  colour = mix(inside, colour, smooth(edge - 0.02f, edge + 0.02f, r));
  return mix(heart * (0.85f + 0.3f * periodicNoise(uv, 32, 7)), colour, smooth(0.17f, 0.20f, r));
}

Rgb checkerColour(const Vec2& uv) {
  const bool right = uv.x >= 0.5f, top = uv.y >= 0.5f;
  if (!right && !top) return {0.7f, 0.1f, 0.1f};
  return Rgb(right == top ? 0.8f : 0.2f);
}

}  // namespace

float periodicNoise(const Vec2& uv, int cells, std::uint32_t seed) {
  const Vec2 place = uv * float(cells), base = floor(place), f = place - base;
  const auto wrap = [&](int i) { return std::uint64_t((i % cells + cells) % cells); };
  const auto corner = [&](int dx, int dy) {
    const std::uint64_t key = wrap(int(base.y) + dy) * std::uint64_t(cells) + wrap(int(base.x) + dx);
    const float angle = 2 * kPiF * hashUniform(seed, key, std::uint32_t(cells));
    return std::cos(angle) * (f.x - float(dx)) + std::sin(angle) * (f.y - float(dy));
  };
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const float x = fade(f.x), y = fade(f.y);
  const float low = corner(0, 0) + x * (corner(1, 0) - corner(0, 0));
  const float high = corner(0, 1) + x * (corner(1, 1) - corner(0, 1));
  return 1.4f * (low + y * (high - low));
}

std::vector<std::string> heightGeneratorNames() {
  std::vector<std::string> names;
  for (const Generator& g : kGenerators) names.emplace_back(g.name);
  return names;
}

HeightGrid generateHeights(const HeightOptions& options) {
  const Generator* const found = std::find_if(std::begin(kGenerators), std::end(kGenerators),
                                              [&](const Generator& g) { return options.name == g.name; });
  if (found == std::end(kGenerators))
    throw ValueError("there is no built-in height map '" + options.name + "'", "patch.heightmap",
                     "use builtin: with one of " + joined(heightGeneratorNames()));
  requireRange("patch.depth", double(options.depth), 0, 2);
  requireRange("patch.count", options.count, 0, 64);
  requireRange("patch.grid", options.grid, 8, kMaxHeightGrid);
  const int count = options.count == 0 ? found->count : options.count;
  HeightGrid grid =
      sampleHeights(options.grid, [&](const Vec2& uv) { return found->height(uv, count, options.seed); });
  const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const float base = *low, range = std::max(*high - *low, 1e-6f);
  for (float& h : grid.heights) h = (h - base) / range * options.depth;
  return grid;
}

std::vector<std::string> textureGeneratorNames() {
  return {"checker", "flower"};
}

Image generateTexture(const std::string& name, int size) {
  const bool flower = name == "flower";
  if (!flower && name != "checker")
    throw ValueError("there is no built-in texture '" + name + "'", "patch.texture",
                     "use builtin: with one of " + joined(textureGeneratorNames()));
  requireRange("patch.texture", size, 2, 4096);
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const Vec2 uv((float(x) + 0.5f) / float(size), 1 - (float(y) + 0.5f) / float(size));
      const Rgb c = clamp(flower ? flowerColour(uv) : checkerColour(uv), Rgb(0), Rgb(1));
      std::copy_n(&c.x, 3, image.pixel(x, y));
    }
  return image;
}

}  // namespace prt
