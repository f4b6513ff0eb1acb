#pragma once
// Baked projects as plain files for other programs: numpy arrays, EXR pictures, glTF.
// Each folder gets a manifest.json that names and describes every file in it; it is written last. Files
// are replaced one by one, each in one step.

#include "libprt/atlas/atlas.h"
#include "libprt/light/light_rig.h"
#include "libprt/meso/patch.h"
#include "libprt/meso/rtt.h"
#include "libprt/project/relight.h"
#include "libprt/transport/error_map.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace prt {

struct SynthesisProduct;
struct IdMapProduct;

/// What there is to export.
struct ExportInput {
  const Recipe& recipe;
  BakedScene baked;
  std::shared_ptr<const FramesProduct> frames;
  LightRig lights;                                   ///< the light that pictures and vertex colours show
  std::shared_ptr<const ErrorMap> errors = nullptr;  ///< written by exportNpy() when given
  std::shared_ptr<const Rtt> rtt = nullptr;          ///< the same
  std::shared_ptr<const Patch> patch = nullptr;      ///< the same
  std::shared_ptr<const Atlas> atlas = nullptr;      ///< texture coordinates and geometry images when given
  std::shared_ptr<const SynthesisProduct> synthesis = nullptr;  ///< the meso mesh when given
  std::shared_ptr<const IdMapProduct> idmap = nullptr;          ///< the same
};

/// Files that were written, relative to the folder.
using ExportedFiles = std::vector<std::string>;

/// .npy files, little-endian, C order, float32 (indices int32); V vertices of the scene, F faces, k =
/// bands^2:
///   positions, normals, tangents [V,3]; faces [F,3]; uv [V',2], uv_faces [F,3] where meshes have them;
///   with an atlas these are its own, and uv_chart [F] int32, geometry_position, geometry_normal,
///   geometry_tangent [size,size,3], geometry_triangle [size,size] int32, geometry_barycentric [size,size,2]
///   transfer [V,k,k] or [V,k,k,3]: row = transferred, column = light, object frame; every form but Diffuse
///   transfer_diffuse [V,k] or [V,k,3]: exit radiance of a white Lambert surface per light coefficient
///   albedo [V,3]; object [V] int32; specular [O,3] of each object, 0 where it is not glossy
///   response [O,512,n,n]: where something is glossy and the form can show it, GlossyResponse as a table,
///   view angle, lobe, band; zeros for objects that are not (docs/handover.md)
///   light [k,3]: coefficients of the current lights
///   rtt [texels,texels,views,views,k] or [..,k,3], when there is one: v, u, view_y, view_x (meso/rtt.h)
///   patch_positions, patch_normals, patch_albedo [P,3], patch_faces [Q,3]: one period of the patch, in its
///   frame error_estimate [V,3], when there is one: Monte Carlo, interpolation, truncation
///   (transport/error_map.h)
///   meso_positions, meso_normals [M,3], meso_patch [M,2] and idmap [size,size,2], when a patch was laid over
///   the surface: the meso mesh with patch coordinates in [0, 1), and those of each texel, -1 outside
/// Throws ResourceError when the expanded matrices do not fit in memory, FileError when it cannot write.
ExportedFiles exportNpy(const ExportInput& input, const std::filesystem::path& folder, Job& job);

/// The radiance transfer texture alone, with a manifest: for projects in which nothing else is baked.
/// `patch` may be null.
ExportedFiles exportRtt(const Rtt& rtt, const Patch* patch, const std::filesystem::path& folder);

/// Everything about the patch on the surface, and the atlas, of a project without transfer: positions,
/// normals, tangents, faces, and the arrays above of what is given. Null pointers are left out.
struct ExportParts {
  const TriMesh& mesh;
  const TangentFrames& frames;
  const Atlas* atlas = nullptr;
  const Rtt* rtt = nullptr;
  const Patch* patch = nullptr;
  const SynthesisProduct* synthesis = nullptr;
  const IdMapProduct* idmap = nullptr;
};
ExportedFiles exportParts(const ExportParts& parts, const std::filesystem::path& folder, Job& job);

/// environment.exr (the lights as a lat-long map, 1024 x 512; discs and directional lights left out),
/// light_bands.exr (the light that transfer sees: `bands` bands, non-negative) and picture_NAME.exr, one of
/// each camera, 960 x 540.
ExportedFiles exportExr(const ExportInput& input, const std::filesystem::path& folder, Job& job);

/// With an atlas also scene.obj, both with its texture coordinates.
/// scene.glb: the whole scene as one mesh with attribute _VERTEX (each vertex's row in exportNpy's arrays)
/// and, as unlit vertex colours, its diffuse exit radiance under the current lights, times 2^exposure,
/// clamped to 0..1.
ExportedFiles exportGltf(const ExportInput& input, const std::filesystem::path& folder, double exposure,
                         Job& job);

}  // namespace prt
