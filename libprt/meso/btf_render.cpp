#include "libprt/meso/btf_render.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/core/image_io.h"
#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/meso/patch_lobe.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace prt {
namespace {

/// Pictures of a patch under directional lights, one texel after the other.
class BtfPass {
 public:
  BtfPass(const PatchScene& patch, const PatchLight& bounced, const PatchLight* surface,
          const LightSet& lights, const RttSettings& settings, BtfView& out)
      : patch_(patch),
        bounced_(bounced),
        surface_(surface),
        settings_(settings),
        lights_(lights),
        out_(out),
        places_(texelSamples(settings.supersamples, settings.seed)),
        row_(bounced.rows.width),
        blocked_(lights.size()) {
    for (const Vec3& d : lights.directions) x_.push_back(d.x), y_.push_back(d.y), z_.push_back(d.z);
  }

  void texel(int u, int v) {
    float* to = &out_.values[std::size_t(v * out_.texels + u) * out_.lights * std::size_t(out_.channels)];
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Hit hit = patch_.rays->intersect(viewRay(
          *patch_.patch, (Vec2(float(u), float(v)) + places_[i]) / float(out_.texels), out_.direction));
      if (hit.valid() && !hit.back)
        add(hit, hashBits(settings_.seed, std::uint64_t(v * out_.texels + u) * 256 + i, 11), to);
    }
    for (std::size_t k = 0; k < out_.lights * std::size_t(out_.channels); ++k) to[k] /= float(places_.size());
  }

 private:
  void add(const Hit& hit, std::uint64_t seed, float* to) {
    const Patch& patch = *patch_.patch;
    const Vec3 normal = normalAt(patch, hit), face = normalize(patch.mesh.areaNormal(hit.triangle));
    patch_.rays->occludedFrom(originAt(patch, hit), x_, y_, z_, blocked_);
    bounced_.at(patch.mesh, hit.triangle, hit.barycentric, row_.data());
    const Rgb albedo = patch.albedoAt(hit.triangle, hit.barycentric) / kPiF;
    const auto channels = std::size_t(out_.channels);
    for (std::size_t l = 0; l < out_.lights; ++l) {
      const Vec3& in = lights_.directions[l];
      const bool lit = !blocked_[l] && dot(face, in) > 0;
      const float cosine = lit ? std::max(0.0f, dot(normal, in)) : 0.0f;
      const Rgb lobe =
          patch.glossy() && cosine > 0 ? evalLobe(patch, hit, in, out_.direction) * cosine : Rgb(0);
      for (std::size_t c = 0; c < channels; ++c)
        to[l * channels + c] +=
            albedo[int(c)] * (cosine + row_[bounced_.channels == 3 ? 3 * l + c : l]) + lobe[int(c)];
    }
    if (surface_)
      addLobeOfPatch(patch_, *surface_, hit, out_.direction, settings_.lobeRays, seed, out_.channels, lobe_,
                     to);
  }

  const PatchScene& patch_;
  const PatchLight& bounced_;
  const PatchLight* surface_;
  const RttSettings& settings_;
  const LightSet& lights_;
  BtfView& out_;
  std::vector<Vec2> places_;
  std::vector<float> row_, x_, y_, z_;
  std::vector<std::uint8_t> blocked_;
  LobeScratch lobe_;
};

bool grey(const Patch& patch) {
  const auto isGrey = [](const Rgb& c) { return c.x == c.y && c.y == c.z; };
  return !patch.albedoTexture && !patch.glossTexture && isGrey(patch.specular) &&
         std::ranges::all_of(patch.albedo, isGrey);
}

nlohmann::json directionJson(const Vec3& d) {
  return {d.x, d.y, d.z};
}

std::string pictureName(int view, std::size_t light) {
  char name[64];
  std::snprintf(name, sizeof name, "view_%03d_light_%03zu.exr", view, light);
  return name;
}

}  // namespace

Image BtfView::picture(std::size_t light) const {
  Image image(texels, texels, 3);
  for (int v = 0; v < texels; ++v)
    for (int u = 0; u < texels; ++u) {
      const float* from = &values[(std::size_t(v * texels + u) * lights + light) * std::size_t(channels)];
      for (int c = 0; c < 3; ++c) image.pixel(u, texels - 1 - v)[c] = colour[c] * from[c % channels];
    }
  return image;
}

void renderBtf(const PatchScene& patch, const RttSettings& settings, const LightSet& lights, Job& job,
               const BtfSink& sink) {
  const ViewSquare square(settings.views);
  std::vector<Vec3> views;
  for (int i = 0; i < square.count(); ++i) views.push_back(square.centre(i));
  renderBtf(patch, settings, lights, views, job, sink);
}

void renderBtf(const PatchScene& patch, const RttSettings& settings, const LightSet& lights,
               std::span<const Vec3> views, Job& job, const BtfSink& sink) {
  if (settings.supersamples < 1 || settings.supersamples > 16)
    throw ValueError("cannot take so many samples a side", "rtt.supersamples", "use 1 to 16");
  PatchTransferBake bake(patch, settings.transfer());
  while (!bake.done()) bake.advance(job);
  const PatchLight bounced = bake.directionalLight(lights.directions, false, job);
  PatchLight surface;
  if (patch.patch->glossy()) surface = bake.directionalLight(lights.directions, true, job);
  BtfView view;
  view.texels = settings.texels, view.lights = lights.size();
  view.channels = bounced.channels == 1 && grey(*patch.patch) ? 1 : 3;
  const auto texels = std::size_t(settings.texels);
  job.begin("images under single lights", double(views.size() * lights.size()), "images");
  for (std::size_t i = 0; i < views.size(); ++i) {
    view.index = int(i), view.direction = views[i];
    view.values.assign(texels * texels * view.lights * std::size_t(view.channels), 0.0f);
    parallelFor(job, 0, texels, 1, [&](std::size_t v, std::size_t) {
      BtfPass pass(patch, bounced, patch.patch->glossy() ? &surface : nullptr, lights, settings, view);
      for (int u = 0; u < settings.texels; ++u) {
        if (u % 16 == 0) job.checkCancelled();
        pass.texel(u, int(v));
      }
    });
    job.advance(double(lights.size()));
    sink(view);
  }
}

void projectView(const BtfView& view, std::span<const double> matrix, Rtt& rtt, Job& job) {
  const std::size_t lights = view.lights, channels = std::size_t(rtt.channels);
  parallelFor(job, 0, std::size_t(view.texels), 1, [&](std::size_t v, std::size_t) {
    for (int u = 0; u < view.texels; ++u) {
      const float* from =
          &view.values[(v * std::size_t(view.texels) + std::size_t(u)) * lights * std::size_t(view.channels)];
      float* to = rtt.block(u, int(v), view.index);
      for (std::size_t k = 0; k < std::size_t(rtt.functions()); ++k)
        for (std::size_t c = 0; c < channels; ++c) {
          double sum = 0;
          for (std::size_t l = 0; l < lights; ++l)
            sum += matrix[k * lights + l] *
                   double(from[l * std::size_t(view.channels) + c % std::size_t(view.channels)]);
          to[k * channels + c] = float(sum);
        }
    }
  });
}

Rtt bakeRttByImages(const PatchScene& patch, const RttSettings& settings, const LightSet& lights,
                    LightFit fit, Job& job, const BtfSink& keep) {
  const std::vector<double> matrix = projectionMatrix(lights, settings.bands, fit);
  Rtt rtt;
  renderBtf(patch, settings, lights, job, [&](const BtfView& view) {
    if (view.index == 0) {
      rtt = Rtt(settings.texels, settings.views, settings.bands, view.channels);
      rtt.colour = view.colour;
      rtt.bounces = settings.bounces, rtt.rays = settings.rays;
    }
    projectView(view, matrix, rtt, job);
    if (keep) keep(view);
  });
  return rtt;
}

BtfWriter::BtfWriter(std::filesystem::path folder, const LightSet& lights)
    : folder_(std::move(folder)), lights_(lights) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (!std::filesystem::is_directory(folder_, error))
    throw FileError("is not a folder and cannot be made one", folder_.string(), "choose another name");
}

void BtfWriter::add(const BtfView& view, Job& job) {
  views_.emplace_back(view.direction, view.index);
  parallelFor(job, 0, view.lights, 1, [&](std::size_t light, std::size_t) {
    writeImage(folder_ / pictureName(view.index, light), view.picture(light));
  });
}

std::size_t BtfWriter::finish() {
  nlohmann::json images = nlohmann::json::array();
  for (const auto& [direction, index] : views_)
    for (std::size_t light = 0; light < lights_.size(); ++light)
      images.push_back({{"file", pictureName(index, light)},
                        {"view", directionJson(direction)},
                        {"light", directionJson(lights_.directions[light])}});
  const nlohmann::json manifest{{"format", "prt-btf"},
                                {"version", 1},
                                {"encoding", "linear"},
                                {"value", "radiance under a light of irradiance 1 across its beam"},
                                {"images", images}};
  writeFile(folder_ / "manifest.json", manifest.dump(1) + "\n");
  return images.size();
}

}  // namespace prt
