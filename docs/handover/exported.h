#pragma once
// The files that `prt export P.prt --gltf GLTF --npy NPY` writes, read with nothing of PRT Studio.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

using Vec3 = std::array<float, 3>;

/// An .npy file of little-endian float32 or int32 in C order.
struct Npy {
  std::vector<std::size_t> shape;
  std::vector<std::uint32_t> words;  // the elements' bits

  const float* floats() const { return reinterpret_cast<const float*>(words.data()); }
  const std::int32_t* ints() const { return reinterpret_cast<const std::int32_t*>(words.data()); }
};
Npy readNpy(const std::filesystem::path& file);

/// The one mesh of scene.glb. `vertex` is its attribute _VERTEX: which row of the .npy arrays a vertex
/// takes (vertices at texture seams are doubled in the glTF, not in the arrays).
struct Mesh {
  std::vector<Vec3> positions, normals;
  std::vector<float> vertex;
  std::vector<std::uint32_t> indices;
};
Mesh readGlb(const std::filesystem::path& file);

struct Camera {
  std::string name;
  Vec3 eye, target, up;
  float verticalFovDegrees = 30;
};

/// Everything that a picture needs. Of the arrays, V = vertices, k = bands^2 functions, O = objects.
struct Exported {
  Mesh mesh;
  int bands = 0;
  std::vector<Camera> cameras;
  Npy albedo;           // [V,3]
  Npy object;           // [V]
  Npy light;            // [k,3]
  Npy transferDiffuse;  // [V,k] or [V,k,3]
  bool full = false;    // whether the next ones are there: the project keeps more than diffuse vectors
  Npy transfer;         // [V,k,k] or [V,k,k,3]
  Npy specular;         // [O,3]
  Npy response;         // [O,rows,bands,bands], empty when nothing is glossy
};
/// Throws std::runtime_error with a line that says what and where.
Exported readExported(const std::filesystem::path& gltfFolder, const std::filesystem::path& npyFolder);
