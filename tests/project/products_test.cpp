#include "libprt/project/products.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

MeshProduct damagedMesh() {
  MeshProduct product;
  product.meshes.push_back(std::make_shared<TriMesh>(makeBox()));
  product.reports.push_back(
      R"({"text":"dropped 2 degenerate faces","facts":"24 vertices","notes":["one line"]})");
  DefectLine holes{DefectKind::Holes, 2, 2, {}}, faces{DefectKind::DegenerateFaces, 3, 0, {}};
  holes.places.add(DefectPlaces::Edges, std::array{DVec3(0), DVec3(1, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)});
  holes.places.add(DefectPlaces::Edges, std::array{DVec3(0, 0, 1), DVec3(1, 0, 1)});
  product.defects.push_back({holes, faces});
  return product;
}

TEST(MeshProduct, ItsDefectsAreKept) {
  const MeshProduct product = damagedMesh();
  const auto again = std::dynamic_pointer_cast<const MeshProduct>(MeshProduct::load(product.save()));
  ASSERT_EQ(again->defects.size(), 1u);
  ASSERT_EQ(again->defects[0].size(), 2u);
  const DefectLine &before = product.defects[0][0], &after = again->defects[0][0];
  EXPECT_EQ(after.kind, before.kind);
  EXPECT_EQ(after.found, 2u);
  EXPECT_EQ(after.left, 2u);
  EXPECT_EQ(after.places, before.places);
  EXPECT_EQ(again->defects[0][1].outcome(), "dropped");
  EXPECT_EQ(again->repairText(0), "dropped 2 degenerate faces");
  EXPECT_EQ(again->factsText(0), "24 vertices");
  EXPECT_EQ(again->notes(0), std::vector<std::string>{"one line"});
}

TEST(MeshProduct, BuiltInMeshesHaveNone) {
  MeshProduct product;
  product.meshes.push_back(std::make_shared<TriMesh>(makeBox()));
  product.reports.emplace_back("{}");
  product.defects.emplace_back();
  const auto again = std::dynamic_pointer_cast<const MeshProduct>(MeshProduct::load(product.save()));
  EXPECT_TRUE(again->defects.at(0).empty());
  EXPECT_EQ(again->factsText(0), "");
}

/// Whatever a file claims, what comes out of it can be drawn, or it is refused.
TEST(MeshProduct, ForgedDefectsAreRefused) {
  using nlohmann::json;
  const ProductData good = damagedMesh().save();
  const auto refused = [&](const std::function<void(ProductData&, json&)>& damage) {
    ProductData data = good;
    json meta = json::parse(data.meta);
    damage(data, meta);
    data.meta = meta.dump();
    try {
      MeshProduct::load(std::move(data));
    } catch (const FileError&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](ProductData&, json&) {}));
  const auto line = [](json& meta) -> json& { return meta["objects"][0]["list"][0]; };
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { line(meta)["kind"] = "other"; }));
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { line(meta)["kind"] = 3; }));
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { line(meta)["shape"] = 0; }));
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { line(meta)["shape"] = 3; }))
      << "four ends are no triangles";
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { line(meta)["found"] = -1; }));
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { meta["objects"][0]["list"] = "text"; }));
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { meta["objects"][0]["text"] = 1; }));
  EXPECT_TRUE(refused([&](ProductData&, json& meta) { meta["objects"][0]["notes"] = {1}; }));
  const auto starts = [](std::vector<std::uint32_t> values) {
    return Array::from<std::uint32_t>(values, {std::int64_t(values.size())});
  };
  EXPECT_TRUE(refused([&](ProductData& data, json&) {
    data.arrays["defectStarts.holes.0"] = starts({0, 600, 6});
  }));
  EXPECT_TRUE(refused([&](ProductData& data, json&) {
    data.arrays["defectStarts.holes.0"] = starts({0, 4});
  }));
  EXPECT_TRUE(refused([&](ProductData& data, json&) { data.arrays["defectStarts.holes.0"] = starts({}); }));
  EXPECT_TRUE(refused([&](ProductData& data, json&) { data.arrays.erase("defectPlaces.holes.0"); }));
  EXPECT_TRUE(refused([&](ProductData& data, json&) {
    std::vector<float> places(18, std::numeric_limits<float>::quiet_NaN());
    data.arrays["defectPlaces.holes.0"] = Array::from<float>(std::span<const float>(places), {6, 3});
  }));
}

}  // namespace
}  // namespace prt
