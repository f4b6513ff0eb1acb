#include "libprt/shade/biscale.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/live_renderer.h"
#include "libprt/shade/raster.h"
#include "libprt/shade/render.h"
#include "libprt/synthesis/orientation_field.h"
#include "libprt/synthesis/surface_point.h"
#include "tests/support/patched_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace prt {
namespace {

using test::grid;
using test::kBands;
using test::kFunctions;
using test::lambert;
using test::lambertRtt;
using test::matrices;
using test::rock;
using test::sceneOf;
using test::variedLight;
using test::variedRtt;
using World = test::PatchedWorld;

/// Equation (4) read out: light at each corner into its frame, interpolated, met with the texture.
Image plainPicture(const World& w, const Transfer& transfer, const ShRgb& light, const Camera& camera,
                   int width, int height, bool viewDependent = true) {
  Job job;
  const TriMesh& mesh = w.scene->mesh;
  const std::vector<Rgb> all =
      transfer.form == TransferForm::None ? std::vector<Rgb>() : transferredRadiance(transfer, light);
  const FragmentImage seen = rasterize(mesh, camera, width, height, 2, job);
  std::vector<Rtt> tables;
  for (int layer = 0; layer < w.rtt.layers; ++layer) tables.push_back(w.table(std::uint32_t(layer)));
  Image image(width, height, 4);
  for (const FragmentTile& tile : seen.tiles)
    for (int p = 0; p < tile.width * tile.height; ++p)
      for (const Fragment& f : tile.pixel(std::size_t(p))) {
        float* to = image.pixel(tile.x + p % tile.width, tile.y + p / tile.width);
        const float share = float(f.samples) / 4;
        to[3] += share;
        const Vec2 patch = w.cover->at(f.triangle, f.barycentric);
        if (f.back || patch.x < 0) continue;
        const UVec3& t = mesh.triangles[f.triangle];
        const Vec3 weight(1 - f.barycentric.x - f.barycentric.y, f.barycentric.x, f.barycentric.y);
        ShRgb here(kBands);
        for (int c = 0; c < 3; ++c) {
          ShRgb at(kBands);
          if (all.empty())
            at = light;
          else
            std::copy_n(all.begin() + std::ptrdiff_t(kFunctions * t[c]), kFunctions, at.c.begin());
          const ShRotation toLocal(kBands, transpose(w.frames->at(mesh, f.triangle, c).matrix()));
          const ShRgb local = toLocal.apply(at);
          for (std::size_t k = 0; k < kFunctions; ++k) here.c[k] += weight[c] * local.c[k];
        }
        const Vec3 n =
            normalize(interpolated(mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z], f.barycentric));
        const Vec3 tangent = tangentAt(*w.frames, f.triangle, f.barycentric, n);
        const Vec3 viewer = camera.towardsViewer(
            interpolated(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], f.barycentric));
        const Vec3 view =
            viewDependent ? Frame{tangent, cross(n, tangent), n}.toLocal(viewer) : Vec3(0, 0, 1);
        const auto [u, v] = w.rtt.texelAt(patch);
        Rgb sum(0);
        const LayerShares shares = w.cover->sharesAt(f.triangle, f.barycentric);
        for (std::size_t layer = 0; layer < shares.count; ++layer)
          sum += shares.weight[layer] * tables[shares.layer[layer]].exitRadiance(u, v, view, here);
        const Rgb exit = share * max(Rgb(0), sum);
        to[0] += exit.x, to[1] += exit.y, to[2] += exit.z;
      }
  return image;
}

double worst(const Image& a, const Image& b) {
  double most = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 4; ++c)
        most = std::max(most, double(std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c])));
  return most;
}

Camera camera() {
  Camera c;
  c.eye = {1.2f, 1.4f, 3.4f};
  return c;
}

TEST(Biscale, IsEquationFour) {
  for (const int channels : {1, 3})
    for (const bool turnSome : {false, true})
      for (const bool viewDependent : {true, false}) {
        const World w(sceneOf(rock(12)), variedRtt(6, 4, channels), turnSome);
        const Transfer transfer = matrices(w.samples.size(), channels);
        const ShRgb light = variedLight();
        const Image fast = w.picture(transfer, light, camera(), 40, 30, viewDependent),
                    plain = plainPicture(w, transfer, light, camera(), 40, 30, viewDependent);
        EXPECT_GT(plain.pixel(20, 15)[0], 0.1f);
        EXPECT_LT(worst(fast, plain), 2e-3) << channels << " channels";  // halfs: 5e-4 of about 2
      }
}

TEST(Biscale, LayersBlendTheirResponses) {
  for (const int layers : {1, 3})
    for (const int channels : {1, 3}) {
      World w(sceneOf(rock(12)), variedRtt(6, 4, channels));
      w.layer(layers);
      const Transfer transfer = matrices(w.samples.size(), channels);
      const ShRgb light = variedLight();
      const Image fast = w.picture(transfer, light, camera(), 40, 30),
                  plain = plainPicture(w, transfer, light, camera(), 40, 30);
      EXPECT_GT(plain.pixel(20, 15)[0], 0.1f);
      EXPECT_LT(worst(fast, plain), 3e-3) << layers << " layers, " << channels << " channels";
    }
}

/// Irradiance vectors of the samples' own.
Transfer diffuseVectorsOf(std::size_t samples) {
  Transfer t;
  t.form = TransferForm::Diffuse, t.bands = kBands, t.samples = samples, t.channels = 1;
  std::vector<float> values(samples * kFunctions);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = (i % kFunctions == 0 ? 1.0f : 0.1f) + 0.2f * test::noise(17, i);
  t.values = Array::from<float>(std::span<const float>(values), {std::int64_t(samples), kFunctions});
  return t;
}

TEST(Biscale, MatteSurfacesAreLitByIrradianceAlone) {
  const World w(sceneOf(rock(12), lambert(Rgb(0.5f))), lambertRtt(0.5f));
  const Transfer transfer = diffuseVectorsOf(w.samples.size());
  const ShRgb light = variedLight();
  Job job;
  BiscaleSurface surface = w.surface();
  EXPECT_THROW(renderBiscale({surface, w.samples, transfer, light}, camera(), 8, 8, 1, job), ValueError)
      << "it is not said to be matte";
  surface.matte = true;
  const Image patch = renderBiscale({surface, w.samples, transfer, light}, camera(), 48, 36, 1, job),
              plain = render({*w.scene, w.samples, transfer, light}, camera(), 48, 36, 1, job);
  int compared = 0;
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 48; ++x) {
      if (patch.rgb(x, y) == Rgb(0)) continue;  // nothing, or a texel that shows nothing
      ++compared;
      EXPECT_LT(distance(patch.rgb(x, y), plain.rgb(x, y)), 2e-3f) << x << ' ' << y;
    }
  EXPECT_GT(compared, 300);
}

TEST(PatchCover, TellsWhatEachLayerShows) {
  IdMap map;
  map.size = 2, map.layers = 2;
  map.ids.assign(8, 7);
  map.weights = {0, 0, 255, 0, 51, 102, 0, 255};
  const auto shares = [&](std::size_t i) {
    const LayerShares s = layerShares(map, i);
    std::vector<std::pair<std::uint32_t, float>> out;
    for (std::size_t n = 0; n < s.count; ++n) out.emplace_back(s.layer[n], s.weight[n]);
    return out;
  };
  using Shares = std::vector<std::pair<std::uint32_t, float>>;
  EXPECT_EQ(shares(0), (Shares{{0, 1.0f}}));
  EXPECT_EQ(shares(1), (Shares{{1, 1.0f}}));
  EXPECT_EQ(shares(2), (Shares{{0, 102.0f / 255}, {1, 51.0f / 255}, {2, 102.0f / 255}}));
  EXPECT_EQ(shares(3), (Shares{{2, 1.0f}}));
}

TEST(Biscale, WithoutTransportTheLightItselfArrives) {
  const World w(sceneOf(rock(12)), variedRtt(6, 4, 1));
  Transfer none;
  const ShRgb light = variedLight();
  EXPECT_LT(worst(w.picture(none, light, camera(), 40, 30), plainPicture(w, none, light, camera(), 40, 30)),
            2e-3);
}

TEST(Biscale, AMattePatchIsAMatteMaterial) {
  // On a plane, where frames do not turn from vertex to vertex, nothing but halfs is between the two.
  const World w(sceneOf(grid({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 6, 6), lambert(Rgb(0.5f))), lambertRtt(0.5f));
  const Transfer transfer = matrices(w.samples.size(), 1);
  const ShRgb light = variedLight();
  Job job;
  const BiscaleSurface surface = w.surface();
  const Image patch = renderBiscale({surface, w.samples, transfer, light}, camera(), 48, 36, 1, job);
  const Image matte =
      render({*w.scene, w.samples, transfer, light, ShadeMethod::Glossy}, camera(), 48, 36, 1, job);
  double most = 0;
  int compared = 0;
  for (int y = 0; y < 36; ++y)
    for (int x = 0; x < 48; ++x)
      if (patch.pixel(x, y)[0] > 0) {  // not an empty place of the map
        most = std::max(most, double(std::abs(patch.pixel(x, y)[0] - matte.pixel(x, y)[0])));
        ++compared;
      }
  EXPECT_GT(compared, 200);
  EXPECT_LT(most, 2e-3);
}

TEST(Biscale, DoesNotDependOnThreads) {
  const World w(sceneOf(rock(12)), variedRtt(6, 4, 3), true);
  const Transfer transfer = matrices(w.samples.size(), 1);
  const ShRgb light = variedLight();
  setThreadCount(1);
  const Image one = w.picture(transfer, light, camera(), 64, 48);
  setThreadCount(3);
  const Image three = w.picture(transfer, light, camera(), 64, 48);
  setThreadCount(0);
  EXPECT_EQ(one.data, three.data);
}

TEST(Biscale, TheLiveRendererShowsTheSame) {
  const World w(sceneOf(rock(12)), variedRtt(6, 4, 3), true);
  LiveScene scene;
  scene.scene = w.scene, scene.samples = std::make_shared<SampleSet>(w.samples);
  scene.transfer = std::make_shared<Transfer>(matrices(w.samples.size(), 1));
  scene.materials = w.scene->materials, scene.light = variedLight();
  scene.patch = std::make_shared<BiscaleSurface>(w.surface());
  LivePicture picture;
  picture.camera = camera(), picture.width = 64, picture.height = 48, picture.grid = 1;
  std::vector<std::uint32_t> pixels(64 * 48);
  LiveRenderer renderer;
  Job job;
  for (const bool viewDependent : {true, false}) {
    scene.viewDependent = viewDependent;
    renderer.draw(scene, picture, pixels, job);
    scene.light.c[0] *= 0.5f;  // the second frame changes the light alone
    renderer.draw(scene, picture, pixels, job);
    const Image linear =
        renderBiscale({*scene.patch, w.samples, *scene.transfer, scene.light, nullptr, viewDependent},
                      camera(), 64, 48, 1, job);
    const DisplayTable display(picture.tone);
    for (int i = 0; i < 64 * 48; ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(double(pixels[std::size_t(i)] >> (16 - 8 * c) & 255),
                    double(display(linear.pixel(i % 64, i / 64)[c])), 1)
            << i;
  }
}

TEST(Biscale, VerticesHaveAsManyFramesAsTangents) {
  const World smooth(sceneOf(rock(12)), variedRtt(4, 2, 1)),
      broken(sceneOf(rock(12)), variedRtt(4, 2, 1), true);
  EXPECT_EQ(smooth.surface().shading.size(), smooth.scene->mesh.vertexCount());
  const BiscaleSurface surface = broken.surface();
  EXPECT_GT(surface.shading.size(), broken.scene->mesh.vertexCount());
  EXPECT_LE(surface.shading.size(), 2 * broken.scene->mesh.vertexCount());
  for (std::size_t i = 0; i < surface.shading.corner.size(); ++i) {
    const std::uint32_t r = surface.shading.corner[i];
    EXPECT_EQ(surface.shading.vertex[r], broken.scene->mesh.triangles[i / 3][int(i % 3)]);
    EXPECT_GT(dot(surface.shading.frame[r].tangent, broken.frames->tangents[i]), 0.9999f);
  }
}

TEST(Biscale, RefusesWhatHoldsTooLittle) {
  const World w(sceneOf(rock(8)), variedRtt(4, 2, 1));
  Transfer diffuse;
  diffuse.form = TransferForm::Diffuse, diffuse.samples = w.samples.size();
  EXPECT_THROW(w.picture(diffuse, variedLight(), camera(), 8, 8), ValueError);
  EXPECT_THROW(w.picture(matrices(7, 1), variedLight(), camera(), 8, 8), ValueError);
}

TEST(PatchCover, RefusesAnotherMeshsAtlas) {
  auto atlas = std::make_shared<Atlas>();
  EXPECT_THROW(PatchCover(atlas, std::make_shared<IdMap>(), 3), ValueError);
  EXPECT_THROW(PatchCover(std::make_shared<TriMesh>(), PatchRepeat{}), ValueError);
}

TEST(ResponseTable, HoldsTheTextureRoundedToHalfs) {
  const Rtt rtt = variedRtt(5, 3, 3);
  const ResponseTable table(rtt);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(table.block(0, 0)) % 64, 0u);
  EXPECT_EQ(table.padded(), 32u);
  EXPECT_EQ(table.texelAt(Vec2(-0.1f, 1.3f)), 1u * 5 + 4);
}

}  // namespace
}  // namespace prt
