// prt compare: how far two pictures are apart.

#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/image_io.h"
#include "libprt/shade/flip.h"
#include "libprt/shade/metrics.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

struct Options {
  std::string image, reference, second, heatmap, metric = "flip";
};

/// The reference's noise taken out, where a second, independent one is there.
nlohmann::json noiseFree(Session& session, const Options& options, const Image& image, const Image& reference,
                         const PixelMask& mask) {
  const Image second = readImage(options.second);
  const NoiseFreeError e = noiseFreeError(image, reference, second, bothMasks(mask, coveredPixels(second)));
  session.say(fmt::format("free of noise    {:.4f} % ({:.4f} to {:.4f} %)", 100 * e.relative(),
                          100 * e.relativeLow(), 100 * e.relativeHigh()));
  return {{"relative", e.relative()},
          {"low", e.relativeLow()},
          {"high", e.relativeHigh()},
          {"mean_square", e.meanSquare},
          {"standard_error", e.standardError}};
}

/// |a - r| of each pixel, the largest channel.
Image differences(const Image& a, const Image& b) {
  Image out(a.width, a.height, 1);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const Rgb d = abs(a.rgb(x, y) - b.rgb(x, y));
      out.pixel(x, y)[0] = std::max({d.x, d.y, d.z});
    }
  return out;
}

void compare(Session& session, const Options& options) {
  if (!options.heatmap.empty()) checkPictureOutput(options.heatmap);
  const Image image = readImage(options.image), reference = readImage(options.reference);
  const PixelMask mask = bothMasks(coveredPixels(image), coveredPixels(reference));
  const ImageErrors e = compareImages(image, reference, mask);
  const FlipResult flip = hdrFlip(image, reference, mask, session.job());
  session.say(fmt::format("pixels           {}", e.pixels));
  session.say(fmt::format("rmse             {:.6g}", e.rmse));
  session.say(fmt::format("relative rmse    {:.4f} %", 100 * e.relativeRmse));
  session.say(fmt::format("maximum          {:.6g}", e.maximum));
  session.say(fmt::format("95th percentile  {:.4f} %", 100 * e.percentile95));
  session.say(fmt::format("FLIP             {:.5f}", flip.mean));
  nlohmann::json result{{"pixels", e.pixels},
                        {"rmse", e.rmse},
                        {"relative_rmse", e.relativeRmse},
                        {"max", e.maximum},
                        {"percentile95", e.percentile95},
                        {"flip", flip.mean}};
  if (!options.second.empty()) result["noise_free"] = noiseFree(session, options, image, reference, mask);
  if (!options.heatmap.empty()) {
    const bool absolute = options.metric == "difference";
    const Image map = absolute ? heatMap(differences(image, reference), float(e.maximum), mask)
                               : heatMap(flip.map, 1, mask);
    ImageWriteOptions write;
    write.alreadySrgb = true;
    writeImage(options.heatmap, map, write);
    result["heatmap"] = options.heatmap;
  }
  session.result(result);
}

}  // namespace

void addCompare(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("compare", "Measure how far a picture is from a reference");
  command->add_option("IMAGE", options->image, "Picture to judge: .exr, .hdr or .png")->required();
  command->add_option("REFERENCE", options->reference, "What it should look like")->required();
  command->add_option("--second-reference", options->second,
                      "Independent reference (another --seed): cancels the references' noise");
  command->add_option("--heatmap", options->heatmap, "Picture of the error to write, .png");
  command->add_option("--heatmap-of", options->metric, "flip, or difference: |a - b| from 0 to its maximum")
      ->check(CLI::IsMember({"flip", "difference"}))
      ->capture_default_str();
  command->footer(
      "Pixels count where both pictures are covered (alpha).\n"
      "Example:\n  prt compare bunny.exr truth.exr --heatmap error.png");
  command->callback([options, &action] { action = [options](Session& s) { compare(s, *options); }; });
}

}  // namespace prt::cli
