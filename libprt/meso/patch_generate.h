#pragma once
// Built-in height fields and colours for patches, all periodic and made from a formula: what section 4.2 of
// Bi-Scale Radiance Transfer drew by hand ("holes", "bins", "stucco", the flower), and two more.

#include "libprt/meso/height_field.h"

#include <string>
#include <vector>

namespace prt {

struct HeightOptions {
  std::string name = "stucco";  ///< one of heightGeneratorNames()
  float depth = 0.1f;           ///< lowest to highest point, relative to the patch width; 0..2
  int count = 0;                ///< features a side, 1..64; 0 = the generator's own
  std::uint32_t seed = 1;       ///< of noise
  int grid = 128;               ///< vertices a side, 8..512
};

/// "bins", "holes", "ripples", "scales", "stucco".
std::vector<std::string> heightGeneratorNames();
/// Throws ValueError, naming the choices, when there is no generator of that name, or an option is out of
/// range.
HeightGrid generateHeights(const HeightOptions& options);

/// Colour textures by name: "flower" (petals on a leaf-green ground), "checker" (for orientation: its first
/// quarter is red), size x size pixels.
std::vector<std::string> textureGeneratorNames();
Image generateTexture(const std::string& name, int size = 256);

/// Gradient noise on the torus: periodic with 1 along both axes, `cells` lattice cells a side, within -1..1.
float periodicNoise(const Vec2& uv, int cells, std::uint32_t seed);

}  // namespace prt
