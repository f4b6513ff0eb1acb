// Products as a forged project file would hold them, every checksum right: whatever load() accepts must be
// safe to use. An input is: stage, newline, description (JSON), newline; then for each array its name, type
// and extents on one line, newline, and its bytes (as many as there are; the rest are zero).

#include "libprt/core/error.h"
#include "libprt/project/products.h"
#include "libprt/project/stages.h"
#include "libprt/shade/surface_light.h"
#include "tests/fuzz/target.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace {

using namespace prt;
using fuzz::require;

constexpr std::size_t kMaxArrayBytes = 1 << 18;

std::string lineFrom(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string line(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

ProductData decode(std::string_view text) {
  ProductData data;
  data.meta = lineFrom(text);
  while (!text.empty() && data.arrays.size() < 16) {
    std::istringstream head(lineFrom(text));
    std::string name;
    int type = 0;
    head >> name >> type;
    Array array{DType(std::abs(type % 8)), {}, {}};
    std::size_t bytes = sizeOf(array.dtype);
    for (std::int64_t extent;
         head >> extent && array.shape.size() < 6 && extent >= 0 && std::size_t(extent) <= kMaxArrayBytes;) {
      if (bytes * std::size_t(extent) > kMaxArrayBytes) break;
      bytes *= std::size_t(extent);
      array.shape.push_back(extent);
    }
    array.bytes.resize(bytes);
    const std::size_t given = std::min(bytes, text.size());
    std::memcpy(array.bytes.data(), text.data(), given);
    text.remove_prefix(given);
    data.arrays[name] = std::move(array);
  }
  return data;
}

std::string encode(const std::string& stage, const ProductData& data) {
  std::ostringstream text;
  text << stage << '\n' << data.meta << '\n';
  for (const auto& [name, array] : data.arrays) {
    text << name << ' ' << int(array.dtype);
    for (const std::int64_t extent : array.shape) text << ' ' << extent;
    text << '\n';
    text.write(reinterpret_cast<const char*>(array.bytes.data()), std::streamsize(array.bytes.size()));
  }
  return text.str();
}

void useMeshes(const MeshProduct& product) {
  std::vector<SceneObject> objects;
  for (std::size_t i = 0; i < product.meshes.size(); ++i) {
    product.repairText(i);
    objects.push_back({"m", product.meshes[i], Mat4(1), Material{}});
  }
  const Scene scene = flattenScene(objects);
  const SampleSet samples = samplesAtVertices(scene);
  require(samples.size() >= scene.mesh.vertexCount());
  const RayScene rays(scene);
}

void useTransfer(const Transfer& transfer) {
  if (transfer.samples > 5000) return;
  ShRgb light(transfer.bands);
  light.c[0] = Rgb(1);
  SampleSet samples;
  samples.shadingNormal.assign(transfer.samples, Vec3(0, 1, 0));
  surfaceLight(transfer, light, samples);
  if (transfer.form != TransferForm::None) diffuseVectors(transfer);
  if (transfer.form != TransferForm::Diffuse && transfer.bands <= 4) expandedMatrices(transfer);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string name = lineFrom(text);
  try {
    for (const Stage& stage : stages()) {
      if (stage.name != name || !stage.load) continue;
      const ProductPtr product = stage.load(decode(text));
      product->save();
      if (const auto* meshes = dynamic_cast<const MeshProduct*>(product.get())) useMeshes(*meshes);
      if (const auto* transfer = dynamic_cast<const TransferProduct*>(product.get()))
        useTransfer(transfer->transfer);
    }
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
  }
  return 0;
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "product",
    .seeds =
        [] {
          const float zeros[1200] = {};
          const auto floats = [&](std::vector<std::int64_t> shape) {
            const Array probe{DType::f32, shape, {}};
            return Array::from<float>(std::span(zeros, probe.size()), shape);
          };
          const std::uint32_t corners[3] = {0, 1, 2};
          const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
          const std::uint8_t buried[3] = {0, 1, 0};
          const Array noCorners = Array::from<std::uint32_t>({}, {0, 3});
          const auto transfer = [](int form, int channels) {
            return nlohmann::json{{"form", form}, {"bands", 2},         {"channels", channels},
                                  {"samples", 3}, {"gathered", 64},     {"rays", 64},
                                  {"bounces", 1}, {"storageError", 0.0}}
                .dump();
          };
          return std::vector<std::string>{
              encode("mesh", {R"({"objects":[{"text":"mended"}]})",
                              {{"positions.0", Array::from<float>(positions, {3, 3})},
                               {"normals.0", Array::from<float>(normals, {3, 3})},
                               {"triangles.0", Array::from<std::uint32_t>(corners, {1, 3})},
                               {"uv.0", floats({3, 2})},
                               {"uvTriangles.0", Array::from<std::uint32_t>(corners, {1, 3})}}}),
              encode("mesh", {R"({"objects":[{}]})",
                              {{"positions.0", Array::from<float>(positions, {3, 3})},
                               {"normals.0", Array::from<float>(normals, {3, 3})},
                               {"triangles.0", Array::from<std::uint32_t>(corners, {1, 3})},
                               {"uv.0", floats({0, 2})},
                               {"uvTriangles.0", noCorners}}}),
              encode("direct", {R"({"bands":2,"rays":64,"gathered":64,"seed":1})",
                                {{"diffuse", floats({3, 4})},
                                 {"visibility", floats({3, 9})},
                                 {"buried", Array::from<std::uint8_t>(buried, {3})}}}),
              encode("transfer", {transfer(0, 1), {}}),
              encode("transfer",
                     {transfer(1, 3), {{"values", floats({3, 4, 3})}, {"surface", floats({3, 4, 3})}}}),
              encode("transfer", {transfer(2, 1), {{"values", floats({3, 9})}, {"diffuse", floats({3, 4})}}}),
              encode("transfer",
                     {transfer(3, 3), {{"values", floats({3, 3, 4, 4})}, {"diffuse", floats({3, 4, 3})}}}),
              encode(
                  "floor",
                  {R"({"interpolation":0.01,"interpolationError":0.001,"product":0.02,"sampling":0.01,"points":100})",
                   {}})};
        },
    .words = {"\"bands\":10,", "\"samples\":2147483647,", "\"channels\":2,", "\"form\":3,", "null", "[", "{",
              "-1", " 0", " 3", " 6", "surface 0 0\n", "values 1 3 4\n", "uv.0 1 0 2\n",
              "positions.1 1 3 3\n", std::string("\0\0\xc0\x7f", 4)},
    .runs = 30000,
    .memoryBase = std::size_t{128} << 20};
