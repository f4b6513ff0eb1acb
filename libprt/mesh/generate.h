#pragma once
// Built-in shapes, made by our own code: deterministic, closed where a solid is, with unit normals and,
// where a natural unwrapping exists, texture coordinates that do not overlap. Lengths are metres; +Y is
// up; things that stand on the ground have their lowest point at y = 0. Every function throws ValueError
// when an option is out of its stated range.

#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace prt {

/// Icosahedron, bisected: 10 * 4^subdivisions + 2 vertices of near equal spacing, no UVs.
struct IcosphereOptions {
  float radius = 1;
  int subdivisions = 4;  ///< 0..9
};
TriMesh makeIcosphere(const IcosphereOptions& options = {});

/// Sphere of meridians and parallels. UV: u along the meridians' longitude, v from the south pole up.
struct SphereOptions {
  float radius = 1;
  int segments = 64;  ///< around the axis, 3..4096
  int rings = 32;     ///< from pole to pole, 2..4096
};
TriMesh makeSphere(const SphereOptions& options = {});

/// Flat rectangle in y = 0, facing +Y. UV: u along +X, v along -Z, both 0..1.
struct PlaneOptions {
  float width = 1;   ///< along X
  float depth = 1;   ///< along Z
  int columns = 16;  ///< cells along X, 1..4096
  int rows = 16;     ///< cells along Z, 1..4096
  /// 0: equal cells. Towards 1, cells shrink near the middle, where contact shadows need samples:
  /// the cell at the centre is (1 - grading) of the equal one.
  float grading = 0;  ///< 0..0.95
};
TriMesh makePlane(const PlaneOptions& options = {});

/// The ground of the built-in scenes: a large graded plane.
TriMesh makeGround(float detail = 1);

/// Box centred at the origin with sharp edges (three vertices per corner). UV: an unfolded cross.
struct BoxOptions {
  Vec3 size{1};
  int cells = 1;  ///< per edge, 1..1024
};
TriMesh makeBox(const BoxOptions& options = {});

/// Torus about the Y axis. UV: u around the axis, v around the tube.
struct TorusOptions {
  float majorRadius = 1;     ///< axis to the tube's centre
  float minorRadius = 0.4f;  ///< of the tube; at most majorRadius
  int segments = 96;         ///< around the axis, 3..4096
  int sides = 40;            ///< around the tube, 3..4096
};
TriMesh makeTorus(const TorusOptions& options = {});

/// Vase of revolution about the Y axis: foot, belly, neck and a flared, rounded lip; hollow, closed as a
/// surface (outer and inner walls meet in the lip). UV: u around, v along the profile.
struct VaseOptions {
  float height = 1;
  float belly = 0.30f;       ///< largest radius of the belly, relative to the height, 0.1..1
  float neck = 0.115f;       ///< smallest radius of the neck, relative to the height, 0.05..belly
  float thickness = 0.022f;  ///< of the wall, relative to the height, 0.005..0.04
  int segments = 64;         ///< around the axis, 3..4096
  int rings = 72;            ///< along the profile, from the foot over the lip to the inner floor, 24..4096
};
TriMesh makeVase(const VaseOptions& options = {});

/// A sitting bird: a smooth blend of ellipsoids and cones, polygonised and relaxed until its triangles
/// are near equilateral. Faces +X, symmetric about z = 0 in shape (not in mesh), genus 0, no UVs.
struct BirdOptions {
  float length = 1;      ///< from beak to tail
  int cellsAlong = 92;   ///< grid cells along the length, 64..400; vertices grow with its square
  int relaxations = 24;  ///< sweeps of smoothing and edge flips, 0..200
};
TriMesh makeBird(const BirdOptions& options = {});

/// A boulder: an icosphere displaced by fractal noise, cut by a few weathered faces, with hollows deep
/// enough to bounce light. No UVs.
struct RockOptions {
  float radius = 0.5f;      ///< before displacement
  int subdivisions = 5;     ///< of the icosphere, 0..9
  float roughness = 0.32f;  ///< depth of the relief relative to the radius, 0..0.6
  int octaves = 6;          ///< of noise, 1..12
  std::uint32_t seed = 1;
};
TriMesh makeRock(const RockOptions& options = {});

/// The shapes above by name, with their default options, for recipes and command lines:
/// "bird", "box", "ground", "icosphere", "plane", "rock", "sphere", "torus", "vase".
std::vector<std::string> builtinMeshNames();
/// `detail` scales the resolution along each direction, 0.05..16, as far as a shape's limits allow
/// (subdivided shapes take the nearest power of two); `seed` serves shapes made from noise. Throws
/// ValueError, naming the choices, when there is none of that name.
TriMesh makeBuiltinMesh(const std::string& name, float detail = 1, std::uint32_t seed = 1);

}  // namespace prt
