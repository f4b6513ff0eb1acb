#include "libprt/gl/surface_overlay.h"

#include "libprt/core/error.h"
#include "tests/gl/gl_test_support.h"
#include "tests/support/scenes.h"

#include <algorithm>

namespace prt {
namespace {

using gl::SurfaceOverlay;

class SurfaceOverlayGl : public test::GlTest {
 protected:
  SurfaceOverlayGl() : mesh(test::rock(40)) {
    picture.camera.eye = {1.5f, 1.2f, 4};
    picture.width = 240, picture.height = 180;
    picture.grid = 1;
    overlay.setMesh(mesh);
  }
  std::vector<float> ramp() const {
    std::vector<float> values;
    for (const Vec3& p : mesh.positions) values.push_back(0.5f + 0.4f * p.y);
    return values;
  }
  /// Edges and points on the front and the back, a patch of faces.
  SurfaceMarks marks() const {
    SurfaceMarks all;
    for (std::size_t t = 0; t < mesh.triangleCount(); t += 7)
      all.edges.insert(all.edges.end(),
                       {mesh.positions[mesh.triangles[t].x], mesh.positions[mesh.triangles[t].y]});
    for (std::size_t v = 0; v < mesh.vertexCount(); v += 41) all.points.push_back(mesh.positions[v]);
    for (std::size_t t = 200; t < 260; ++t)
      for (int k = 0; k < 3; ++k) all.triangles.push_back(mesh.positions[mesh.triangles[t][k]]);
    return all;
  }
  /// Share of pixels where the two renderers differ visibly.
  double disagreement(std::span<const float> values, const SurfaceMarks& some) {
    overlay.setValues(values);
    overlay.setMarks(some);
    Job job;
    const Image cpu = drawSurfaceOverlay(mesh, values, some, picture, job), gpu = overlay.render(picture);
    std::size_t different = 0, drawn = 0;
    for (std::size_t i = 0; i < cpu.pixels(); ++i) {
      float most = 0;
      for (std::size_t c = 0; c < 4; ++c)
        most = std::max(most, std::abs(cpu.data[4 * i + c] - gpu.data[4 * i + c]));
      different += most > 2.5f / 255;
      drawn += cpu.data[4 * i + 3] > 0;
    }
    EXPECT_GT(drawn, cpu.pixels() / 50) << "something is drawn";
    return double(different) / double(cpu.pixels());
  }

  TriMesh mesh;
  OverlayPicture picture;
  SurfaceOverlay overlay;
};

TEST_F(SurfaceOverlayGl, FalseColourIsTheCpus) {
  EXPECT_LT(disagreement(ramp(), {}), 0.005);
}

TEST_F(SurfaceOverlayGl, SoAreMarks) {
  SurfaceMarks edges, points, faces;
  edges.edges = marks().edges;
  points.points = marks().points;
  faces.triangles = marks().triangles;
  EXPECT_LT(disagreement({}, edges), 0.01);
  EXPECT_LT(disagreement({}, points), 0.01);
  EXPECT_LT(disagreement({}, faces), 0.01);
  EXPECT_LT(disagreement(ramp(), marks()), 0.015);
}

TEST_F(SurfaceOverlayGl, ManySamplesSmoothTheOutline) {
  picture.grid = 2;
  EXPECT_LT(disagreement(ramp(), marks()), 0.03);
}

TEST_F(SurfaceOverlayGl, UnknownValuesAreTheCpus) {
  std::vector<float> values = ramp();
  for (std::size_t v = 0; v < values.size() / 2; ++v) values[v] = -1;
  EXPECT_LT(disagreement(values, {}), 0.01);
}

TEST_F(SurfaceOverlayGl, SoIsPaintWithSquaresAndSeams) {
  SurfacePaint paint;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    paint.colors.push_back(Rgb(0.2f + 0.1f * float(t % 7), 0.4f, 0.6f));
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[mesh.triangles[t][k]];
      paint.uv.push_back(Vec2(p.x, p.y) - Vec2(0.3f));
    }
  }
  paint.squares = 6;
  paint.seams.edges = marks().edges;
  paint.seams.hidden = 0;
  overlay.setPaint(paint);
  overlay.setMarks(marks());
  Job job;
  const auto off = [&] {
    const SurfaceMarks over = marks();
    const Image cpu = drawSurfaceOverlay(mesh, {}, paint, std::span(&over, 1), picture, job),
                gpu = overlay.render(picture);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cpu.data.size(); ++i)
      different += std::abs(cpu.data[i] - gpu.data[i]) > 2.5f / 255;
    return double(different) / double(cpu.data.size());
  };
  EXPECT_LT(off(), 0.02);
  paint.uv.clear();
  EXPECT_GT(off(), 0.05) << "the squares are there";
  overlay.setPaint(paint);
  EXPECT_LT(off(), 0.02);
  paint.colors.resize(1);
  EXPECT_THROW(overlay.setPaint(paint), ValueError);
}

TEST_F(SurfaceOverlayGl, SoIsAPictureInTextureSpace) {
  SurfacePaint paint;
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) paint.uv.push_back(0.4f * Vec2(mesh.positions[t[k]]) + Vec2(0.5f));
  Image texture(8, 5, 3);
  for (std::size_t i = 0; i < texture.data.size(); ++i) texture.data[i] = float(i * 37 % 101) / 100;
  paint.picture = std::make_shared<const Image>(std::move(texture));
  overlay.setPaint(paint);
  Job job;
  const auto off = [&] {
    const Image cpu = drawSurfaceOverlay(mesh, {}, paint, {}, picture, job), gpu = overlay.render(picture);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cpu.data.size(); ++i)
      different += std::abs(cpu.data[i] - gpu.data[i]) > 2.5f / 255;
    return double(different) / double(cpu.data.size());
  };
  EXPECT_LT(off(), 0.02);
  paint.picture = std::make_shared<const Image>(8, 5, 3);
  EXPECT_GT(off(), 0.05) << "the picture is there";
}

TEST_F(SurfaceOverlayGl, SoAreLayersOfMarksWithSizesOfTheirOwn) {
  std::vector<SurfaceMarks> layers(2, marks());
  layers[0].points.clear(), layers[0].edges.clear(), layers[0].fill = 0.35f;
  layers[1].triangles.clear(), layers[1].size = 2, layers[1].color = Rgb(0.2f, 0.6f, 0.9f);
  Job job;
  const auto off = [&](std::span<const SurfaceMarks> cpuLayers) {
    const Image cpu = drawSurfaceOverlay(mesh, {}, {}, cpuLayers, picture, job),
                gpu = overlay.render(picture);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cpu.data.size(); ++i)
      different += std::abs(cpu.data[i] - gpu.data[i]) > 2.5f / 255;
    return double(different) / double(cpu.data.size());
  };
  overlay.setMarks(std::span<const SurfaceMarks>(layers));
  EXPECT_LT(off(layers), 0.01);
  EXPECT_GT(off(std::span(layers).first(1)), 0.01) << "the second layer is there";
  layers[1].size = 1;
  EXPECT_GT(off(layers), 0.002) << "and larger than the first";
}

/// The picture below is left as it is where nothing lies over it.
TEST_F(SurfaceOverlayGl, LaysOverAPicture) {
  EXPECT_TRUE(overlay.empty());
  SurfaceMarks one;
  one.points = {{0, 0, 0}};  // inside: shines through
  overlay.setMarks(one);
  EXPECT_FALSE(overlay.empty());
  const gl::Framebuffer target =
      gl::Framebuffer::create(picture.width, picture.height, gl::PixelFormat::Rgba32f, false);
  const Image before = target.read();
  overlay.draw(picture, target.id());
  const Image after = target.read();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < after.pixels(); ++i) changed += before.data[4 * i] != after.data[4 * i];
  EXPECT_GT(changed, 40u);
  EXPECT_LT(changed, 120u) << "a disc of a few pixels";
}

TEST_F(SurfaceOverlayGl, ValuesMustFitTheMesh) {
  EXPECT_THROW(overlay.setValues(std::vector<float>(3, 0.0f)), ValueError);
  overlay.setValues(ramp());
  overlay.setMesh(test::rock(12));
  EXPECT_TRUE(overlay.empty()) << "values of another mesh are forgotten";
}

}  // namespace
}  // namespace prt
