#pragma once
// Seeds: the bytes that the writer makes of small meshes.

#include "libprt/core/file.h"
#include "libprt/mesh/mesh_writer.h"
#include "tests/fuzz/mesh_harness.h"
#include "tests/support/temporary_folder.h"

namespace prt::fuzz {

inline std::vector<std::string> writtenSeeds(const std::string& extension) {
  const test::TemporaryFolder folder;
  std::vector<std::string> seeds;
  Job job;
  for (const TriMesh& mesh : seedMeshes()) {
    writeMesh(folder / ("seed" + extension), mesh, {}, job);
    const std::vector<std::byte> bytes = readFile(folder / ("seed" + extension));
    seeds.emplace_back(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return seeds;
}

inline std::vector<std::string> joined(std::vector<std::string> some,
                                       const std::vector<std::string>& others) {
  some.insert(some.end(), others.begin(), others.end());
  return some;
}

}  // namespace prt::fuzz
