#pragma once
// The recipe: every parameter of a project as one plain value. Undo is the previous recipe; the command
// line edits it by path ("transfer.bounces=3"), the studio by forms. In JSON angles are degrees, colours
// linear Rec.709 and every key has a default. Reading is strict: an unknown key, a wrong type or a value
// out of range is a ValueError that names the path and, for a name, the nearest valid one.
//
// "mesh", "transform" and "material" are short for objects[0].mesh and so on, in JSON and in paths, and
// a mesh given as a plain string means its path.

#include "libprt/core/math.h"
#include "libprt/material/material.h"
#include "libprt/meso/patch_options.h"
#include "libprt/shade/camera.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace prt {

/// Version of the JSON layout that this program writes; it reads this one and those before.
inline constexpr int kRecipeVersion = 1;

enum class MeshOrientation { Keep, Consistent, Outward };

/// Where a mesh comes from and how it is repaired (see mesh/repair.h).
struct MeshRecipe {
  std::string path = "builtin:vase";  ///< file relative to the recipe, or "builtin:NAME"
  float detail = 1;                   ///< resolution of a built-in mesh, relative to the generator's own
  std::uint64_t seed = 1;             ///< of a built-in mesh's noise
  bool weld = true;                   ///< merge vertices at one position
  MeshOrientation orientation = MeshOrientation::Outward;
  bool splitNonManifold = false;
  bool keepNormals = true;  ///< of the file, where it has them
  float crease = 180;       ///< degrees: computed normals are not smoothed across sharper edges
  bool operator==(const MeshRecipe&) const = default;
};

/// Scale first, then turns about x, y, z (degrees, in this order), then moves.
struct TransformRecipe {
  Vec3 translate{0};
  Vec3 rotate{0};
  Vec3 scale{1};

  Mat4 matrix() const;
  bool operator==(const TransformRecipe&) const = default;
};

struct ObjectRecipe {
  std::string name = "object";
  bool visible = true;  ///< false: as if the object were not in the list
  bool patch = true;    ///< carries the patch where one is laid; false: shows its material there too
  /// Stands around the others: it is not baked, but lights them as the middle of them sees it
  /// (shade/surroundings.h).
  bool captured = false;
  Rgb emission{0};  ///< captured: radiance that it sends of its own
  MeshRecipe mesh;
  TransformRecipe transform;
  Material material;
  std::string seams;  ///< cuts by hand: chains of the mesh's vertex numbers, "4 8 15;16 23" (atlas/seams.h)
  /// Corners, weights and places of single charts, each named by one of the mesh's triangles:
  /// "12 weight=2 corners=5;40 place=0.5,0.5,30,0.2 locked" (atlas/chart_settings.h).
  std::string charts;
  bool operator==(const ObjectRecipe&) const = default;
};

enum class LightKind { Environment, Circle, Directional, Constant };

struct LightRecipe {
  std::string name = "light";
  LightKind kind = LightKind::Environment;
  bool on = true;                          ///< off: as if the light were not in the list
  std::string path = "builtin:clear-sky";  ///< environment: file or "builtin:NAME"
  std::string mapping = "auto";            ///< environment: layout of the image
  float sunAzimuth = -135;  ///< builtin:clear-sky: degrees from -Z, counter-clockwise from above
  float sunElevation = 45;  ///< builtin:clear-sky: degrees above the horizon
  float rotation = 0;       ///< degrees about +Y, counter-clockwise seen from above
  float intensity = 1;      ///< factor on everything this light sends
  Vec3 direction{0, 1, 0};  ///< circle, directional: towards the light; any length but 0
  float angle = 30;         ///< circle: degrees across, edge to edge
  Rgb radiance{1};          ///< circle, constant: radiance; directional: irradiance on a surface facing it
  bool operator==(const LightRecipe&) const = default;
};

struct CameraRecipe {
  std::string name = "main";
  Vec3 eye{0, 0, 3};
  Vec3 target{0};
  Vec3 up{0, 1, 0};
  float verticalFov = 30;  ///< degrees, full angle
  bool orthographic = false;

  Camera camera() const;
  bool operator==(const CameraRecipe&) const = default;
};

enum class TransferKind { Auto, None, Diffuse, Visibility, Matrix };
enum class TransferStorage { Auto, Float, Half };
enum class TransferWhere { Vertex, Texel };

struct TransferRecipe {
  TransferKind kind = TransferKind::Auto;
  TransferWhere where = TransferWhere::Vertex;  ///< texel: at the texels of the atlas
  int texels = 256;                             ///< texel: along a side of the atlas
  int bands = 5;
  int rays = 4096;
  int bounces = 3;
  bool shadows = true;
  float threshold = 0.001f;  ///< bounces end early when one adds less than this fraction
  TransferStorage storage = TransferStorage::Auto;
  float compress =
      0;  ///< relative error that clustering matrices may add (transport/cluster_transfer.h); 0: none
  std::uint64_t seed = 1;
  bool operator==(const TransferRecipe&) const = default;
};

enum class RttStorage { Float, Half, Byte };

/// The radiance transfer texture of the patch (meso/rtt_bake.h).
struct RttRecipe {
  int texels = 64;
  int views = 8;
  int bands = 5;
  int rays = 1024;
  int bounces = 2;
  int supersamples = 4;
  int lobeRays = 16;
  RttStorage storage = RttStorage::Float;
  std::uint64_t seed = 1;
  bool operator==(const RttRecipe&) const = default;
};

enum class ChartsMode { Auto, Manual, Imported };
enum class ChartsBoundary { Free, Polygon };

/// How the surface is cut and laid flat (atlas/auto_cut.h, atlas/flatten.h).
struct ChartsRecipe {
  ChartsMode mode = ChartsMode::Auto;
  float stretch = 1.10f;  ///< auto: bound on the L2 stretch of all charts together
  float creases = 1;      ///< auto: how much seams keep to creases and valleys, 0..1
  ChartsBoundary boundary = ChartsBoundary::Free;
  int corners = 8;  ///< of the polygon of each chart
  bool operator==(const ChartsRecipe&) const = default;
};

/// How charts are packed (atlas/pack.h).
struct AtlasRecipe {
  int size = 2048;
  int gutter = 1;
  int turns = 16;
  std::string placements;  ///< charts that stay where they were put, see parsePlacements()
  bool operator==(const AtlasRecipe&) const = default;
};

/// Turns that leave the patch looking as it does.
enum class FieldSymmetry { None, HalfTurn, QuarterTurn };

/// The direction along which patches are laid (synthesis/orientation_field.h).
struct FieldRecipe {
  FieldSymmetry symmetry = FieldSymmetry::None;
  float angle = 0;      ///< degrees against the general course, counter-clockwise from outside
  std::string strokes;  ///< painted: see parseStrokes()
  float width = 0.02f;  ///< of the band that follows a stroke, relative to the bounding box's diagonal
  bool operator==(const FieldRecipe&) const = default;
};

enum class PatchMapping { Synthesis, Uv };

/// How the patch is laid over the surface (synthesis/texture_synthesis.h, synthesis/direct_mapping.h).
struct SynthesisRecipe {
  PatchMapping mapping = PatchMapping::Synthesis;
  int vertices = 960'000;  ///< of the meso mesh; 0 = one for each texel of the patch
  float scale = 0.08f;     ///< patch width relative to the bounding box's diagonal
  float jitter = 0;
  int passes = 2;
  std::string wishes;  ///< painted: see parseWishes()
  int repeat = 8;      ///< Uv: patches along u
  std::uint64_t seed = 1;
  bool operator==(const SynthesisRecipe&) const = default;
};

/// A further patch that covers the one below it where it is painted (shade/patch_layers.h).
struct LayerRecipe {
  std::string name = "layer";
  PatchOptions patch;
  std::string spots;  ///< painted: see parseSpots()
  bool operator==(const LayerRecipe&) const = default;
};

/// The id map (synthesis/id_map.h).
struct IdMapRecipe {
  int size = 2048;
  int neighbours = 20;
  bool operator==(const IdMapRecipe&) const = default;
};

/// How a picture is made from the products; baking does not read it.
struct MethodRecipe {
  std::string name = "auto";
  bool viewDependent = true;  ///< of the patch
  bool filter = false;        ///< of the patch (shade/patch_filter.h)
  std::string window = "none";
  bool operator==(const MethodRecipe&) const = default;
};

struct Recipe {
  std::vector<ObjectRecipe> objects{ObjectRecipe{}};
  std::vector<LightRecipe> lights{LightRecipe{}};
  std::vector<CameraRecipe> cameras;  ///< empty: a view that frames everything
  ChartsRecipe charts;
  AtlasRecipe atlas;
  TransferRecipe transfer;
  PatchOptions patch;
  std::vector<LayerRecipe> layers;  ///< over it, the lowest first
  RttRecipe rtt;
  FieldRecipe field;
  SynthesisRecipe synthesis;
  IdMapRecipe idmap;
  MethodRecipe method;
  bool operator==(const Recipe&) const = default;
};

// ---- JSON ----

/// Every value, defaults included.
nlohmann::json recipeToJson(const Recipe& recipe);
/// Keys that are absent keep their defaults. `where` begins every error message.
Recipe recipeFromJson(const nlohmann::json& json, const std::string& where);
/// The same from text; a syntax error or a key given twice is a ValueError too.
Recipe recipeFromText(const std::string& text, const std::string& where);
/// Reads a .json file. Throws FileError when it cannot be read or is not a recipe's size.
Recipe loadRecipe(const std::filesystem::path& file);

/// What no single value can tell: at least one object, no object flattened, lights with a direction,
/// cameras that see something. Throws ValueError with the path behind `where`.
void checkRecipe(const Recipe& recipe, const std::string& where);

// ---- paths ----

enum class ParameterType { Boolean, Integer, Number, Text, File, Choice, Color, Vector };
std::string toString(ParameterType type);

/// What there is to know about one parameter: the source of JSON reading and writing, paths, tooltips,
/// `prt bake --help` and docs/recipe.md.
struct Parameter {
  std::string path;  ///< "objects[].mesh.path"; [] stands for an index
  ParameterType type = ParameterType::Number;
  std::string unit;  ///< "degrees", "rays", or empty
  double low = 0;    ///< numbers, and each component of a colour or vector; low == high: no limits
  double high = 0;
  std::vector<std::string> choices;
  std::string defaultText;  ///< as JSON
  std::string cost;         ///< what a change costs, in words
  std::string doc;          ///< one line
};

/// All parameters, in the recipe's order.
const std::vector<Parameter>& parameters();
/// The parameter that a path means, short forms and indices included. Throws ValueError, naming the
/// nearest valid path, when there is none.
const Parameter& parameterAt(const std::string& path);

/// Sets one value from text: JSON, or plain text where a string, choice, file, colour ("1,0.5,0" or one
/// grey value) or vector ("0,1,0") is wanted. lights[N] and the like may be one past the end: it is
/// appended. Throws ValueError and leaves the recipe unchanged.
void setByPath(Recipe& recipe, const std::string& path, const std::string& value);
/// Applies "PATH=VALUE".
void setByAssignment(Recipe& recipe, const std::string& assignment);
/// The value as JSON.
nlohmann::json getByPath(const Recipe& recipe, const std::string& path);
/// Paths of every value in this recipe, with indices.
std::vector<std::string> pathsOf(const Recipe& recipe);

/// A relative path seen from folder `from` as one seen from folder `to`; absolute and built-in ones stay.
std::string rebasedPath(const std::string& path, const std::filesystem::path& from,
                        const std::filesystem::path& to);
/// The same for all file paths of a recipe.
void rebasePaths(Recipe& recipe, const std::filesystem::path& from, const std::filesystem::path& to);

/// "builtin:NAME" or "scene:NAME" rather than a file.
bool isBuiltin(const std::string& path);

/// Those of `names` that are nearest to `name` by edit distance; empty when nothing is near.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

}  // namespace prt
