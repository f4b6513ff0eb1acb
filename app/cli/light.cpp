// prt light: a light in spherical harmonics, and what is lost by keeping few bands.

#include "app/cli/session.h"
#include "app/cli/view_options.h"
#include "libprt/core/log.h"
#include "libprt/light/environment.h"
#include "libprt/light/projection.h"
#include "libprt/project/lights.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

struct Options {
  std::string path, mapping = "auto", basis = "sh", window = "none", output;
  int bands = 5;
  double rotate = 0;
};

nlohmann::json coefficientsJson(const ShRgb& light) {
  nlohmann::json all = nlohmann::json::array();
  for (const Rgb& c : light.c) all.push_back({c.x, c.y, c.z});
  return all;
}

void tellCoefficients(const Session& session, const ShRgb& light) {
  session.say("   l   m            red          green           blue");
  for (int l = 0; l < light.bands; ++l)
    for (int m = -l; m <= l; ++m) {
      const Rgb& c = light.c[std::size_t(shIndex(l, m))];
      session.say(fmt::format("{:4} {:3} {:14.6f} {:14.6f} {:14.6f}", l, m, c.x, c.y, c.z));
    }
}

void tellBands(const Session& session, const BandSpectrum& s) {
  session.say("band         power   of all energy   error of stopping here");
  for (std::size_t l = 0; l < s.power.size(); ++l)
    session.say(fmt::format("{:4} {:13.6g} {:13.3f} % {:22.3f} %", l, s.power[l],
                            s.energy > 0 ? 100 * s.power[l] / s.energy : 0, 100 * s.truncation[l]));
}

/// Writes the light band-limited. Returns the window it was written through.
std::string writeLight(const Session& session, const Options& options, const ShRgb& light) {
  const std::string window = windowOfPictures(options.window);
  const EnvironmentMap map = bandLimitedMap(windowed(light, window), 512, 256);
  writePicture(options.output, map.pixels(), 0);
  const std::size_t negative = map.report().negative;
  if (negative > 0 && (window == "hann" || window == "lanczos"))
    logWarning(
        fmt::format("{}: {} of {} pixels are negative after the window {} and were written as 0; dering and "
                    "fejer leave none",
                    options.output, negative, map.pixels().pixels(), window));
  session.say(fmt::format("wrote {}: the light in {} bands through the window {}", options.output,
                          options.bands, window));
  return window;
}

void light(Session& session, const Options& options) {
  if (!options.output.empty()) checkPictureOutput(options.output);
  EnvironmentCache cache;
  LightRig rig;
  rig.environment = cache.get(options.path, options.mapping, ".");
  rig.rotation = float(radians(options.rotate));
  const EnvironmentReport& report = rig.environment->report();
  if (const std::string warning = report.warning(); !warning.empty())
    logWarning(options.path + ": " + warning);
  const ShRgb raw = projectEnvironment(*rig.environment, options.bands, session.job());
  const ShRgb all = projectLights(rig, raw), coefficients = windowed(all, options.window);
  const BandSpectrum spectrum = bandSpectrum(*rig.environment, raw);
  session.say(fmt::format("{}: {} x {}, {}; {:.1f} stops; mean radiance {:.4g} {:.4g} {:.4g}", options.path,
                          report.width, report.height, toString(report.mapping), report.stops(),
                          report.mean.x, report.mean.y, report.mean.z));
  tellCoefficients(session, coefficients);
  tellBands(session, spectrum);
  nlohmann::json written;
  if (!options.output.empty())
    written = {{"file", options.output}, {"window", writeLight(session, options, all)}};
  session.result({{"file", options.path},
                  {"mapping", toString(report.mapping)},
                  {"width", report.width},
                  {"height", report.height},
                  {"mean", {report.mean.x, report.mean.y, report.mean.z}},
                  {"basis", options.basis},
                  {"bands", options.bands},
                  {"window", options.window},
                  {"coefficients", coefficientsJson(coefficients)},
                  {"energy", spectrum.energy},
                  {"power", spectrum.power},
                  {"truncation_error", spectrum.truncation},
                  {"written", written}});
}

}  // namespace

void addLight(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("light", "Show a light's coefficients, energy and truncation error per band");
  command->add_option("ENVIRONMENT", options->path, "EXR, HDR or PNG in any common mapping, or builtin:NAME")
      ->required();
  command
      ->add_option("--mapping", options->mapping,
                   "Layout of the image: auto, latlong, vcross, hcross, angular, hstrip or vstrip")
      ->check(CLI::IsMember(parameterAt("lights[].mapping").choices))
      ->capture_default_str();
  command->add_option("--basis", options->basis, "Functions to project on: sh")
      ->check(CLI::IsMember({"sh"}))
      ->capture_default_str();
  command->add_option("--bands", options->bands, "Spherical-harmonic bands; n bands have n^2 functions")
      ->check(CLI::Range(1, kMaxShBands))
      ->capture_default_str();
  command
      ->add_option("--rotate", options->rotate, "Turn about +Y in degrees, counter-clockwise seen from above")
      ->check(finite());
  command->add_option("--window", options->window, "Against ringing: none, hann, lanczos, fejer or dering")
      ->check(CLI::IsMember(parameterAt("method.window").choices))
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "Write the band-limited light as a lat-long .exr, through --window, or fejer when "
                      "there is none: a picture has no negative light");
  command->footer(
      "Index of a coefficient: l(l+1)+m; real, orthonormal, no Condon-Shortley sign.\n"
      "Example:\n  prt light sky.hdr --bands 7 -o sky7.exr");
  command->callback([options, &action] { action = [options](Session& s) { light(s, *options); }; });
}

}  // namespace prt::cli
