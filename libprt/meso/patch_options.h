#pragma once
// The parameters of a patch as plain values, without what they make (patch_build.h).

#include "libprt/core/math.h"

#include <cstdint>
#include <string>

namespace prt {

enum class PatchModel { None, Flat, HeightField, Weave, Mesh, Btf };

/// Section `patch` of the recipe; lengths relative to the patch's width.
struct PatchOptions {
  PatchModel model = PatchModel::None;
  std::string heightmap = "builtin:stucco";  ///< heightfield: image, or builtin:NAME of a generator
  std::string mesh;                          ///< mesh: file of one period, +Y outwards
  std::string btf;                           ///< btf: manifest.json of a folder of images
  bool seamless = false;                     ///< btf: take away the steps at its borders
  std::string texture;                       ///< albedo over the patch: image or builtin:NAME; empty: none
  std::string gloss;                         ///< factor on specular over the patch: image; empty: none
  float depth = 0.12f;                       ///< heightfield and weave: lowest to highest point
  int grid = 128;                            ///< heightfield: vertices a side, at most
  int count = 0;                             ///< built-in height maps: features a side; 0 = their own
  std::uint64_t seed = 1;                    ///< built-in height maps: of their noise
  int yarns = 6;                             ///< weave, along each direction
  float radius = 0.42f;                      ///< weave: half a yarn's width against their distance
  float amplitude = 1.1f;                    ///< weave: crossing amplitude against the least
  float period = 0;                          ///< mesh: its period in its own unit; 0 = its larger extent
  Rgb albedo{0.5f};
  Rgb warp{1};  ///< weave: factor on the albedo of the yarns along v
  Rgb specular{0};
  float exponent = 32;
  bool operator==(const PatchOptions&) const = default;
};

}  // namespace prt
