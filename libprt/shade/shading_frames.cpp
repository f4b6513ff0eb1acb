#include "libprt/shade/shading_frames.h"

namespace prt {
namespace {

ShTurns<float> intoFrame(const Frame& frame) {
  const ShTurns<double> exact = shTurns(glm::transpose(glm::dmat3(frame.matrix())));
  const auto rounded = [](const ShTurns<double>::Turn& t) {
    return ShTurns<float>::Turn{float(t.cosine), float(t.sine)};
  };
  return {rounded(exact.a), rounded(exact.b), rounded(exact.c)};
}

}  // namespace

ShadingFrames shadingFrames(const TriMesh& mesh, const TangentFrames& frames) {
  constexpr float kSame = 1 - 1e-6f;
  constexpr std::uint32_t kEnd = 0xffffffffu;
  ShadingFrames out;
  out.corner.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> first(mesh.vertexCount(), kEnd), next;  // lists of each vertex' frames
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = mesh.triangles[t][c];
      const Vec3& tangent = frames.tangents[3 * t + std::size_t(c)];
      std::uint32_t r = first[v];
      while (r != kEnd && dot(out.frame[r].tangent, tangent) < kSame) r = next[r];
      if (r == kEnd) {
        r = std::uint32_t(out.vertex.size());
        out.vertex.push_back(v);
        out.frame.push_back(frames.at(mesh, t, c));
        out.turns.push_back(intoFrame(out.frame.back()));
        next.push_back(first[v]);
        first[v] = r;
      }
      out.corner[3 * t + std::size_t(c)] = r;
    }
  return out;
}

}  // namespace prt
