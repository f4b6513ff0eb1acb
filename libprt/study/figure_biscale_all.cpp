// All figures of Bi-Scale Radiance Transfer and its numbers, on one page.

#include "libprt/study/bench.h"
#include "libprt/study/figure_kit.h"
#include "libprt/study/figure_list.h"
#include "libprt/study/figure_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace prt {
namespace {

struct Part {
  const char* name;
  nlohmann::json (*make)(const FigureRequest&, Job&);
  const char* picture;
  const char* text;
};
constexpr Part kParts[] = {{"biscale-1", makeBiscale1, "both.png", "Figure 1: either scale and both"},
                           {"biscale-6", makeBiscale6, "full.png", "Figures 2 and 6: id map, scales, views"},
                           {"biscale-3", makeBiscale3, "bounces.png", "Figure 3: kinds of macro transport"},
                           {"biscale-4", makeBiscale4, "steep_left.png", "Figure 4: views and lights"},
                           {"biscale-5", makeBiscale5, "weave.png", "Figure 5: textures"},
                           {"biscale-truth", makeBiscaleTruth, "both.png", "Against the truth"}};

std::string minutes(double seconds) {
  return seconds < 90 ? fmt::format("{:.1f} s", seconds) : fmt::format("{:.1f} min", seconds / 60);
}

/// The paper's section 6, measured here.
std::vector<FigureNumber> numbersOf(const BenchResult& frames, const BenchResult& pipeline) {
  const auto seconds = [&](std::initializer_list<const char*> stages) {
    double sum = 0;
    for (const char* stage : stages)
      if (const auto found = pipeline.details.find(std::string("seconds_") + stage);
          found != pipeline.details.end())
        sum += found->second;
    return minutes(sum);
  };
  return {
      {"frames a second, 512 x 512, weave, matrices", "14.5 (Radeon 9700)",
       fmt::format("{:.0f} on {:.0f} threads of the CPU", frames.ours.value, pipeline.details.at("threads"))},
      {"vertices with a 25 x 25 matrix", "10 800", fmt::format("{:.0f}", frames.details.at("vertices"))},
      {"charts, laid flat and packed", "by hand", seconds({"charts", "atlas"})},
      {"radiance transfer texture of the weave", "8192 images of 0.7 to 3 s, then 5 to 10 min",
       seconds({"rtt"})},
      {"texton extraction and synthesis", "5 to 7 h", seconds({"field", "synthesis"})},
      {"id map of 2048 x 2048", "-", seconds({"idmap"})},
      {"macro transfer", "8 min; 17 min with three bounces", seconds({"rays", "direct", "transfer"})},
      {"from the mesh to the first frame", "about 8 h", minutes(pipeline.ours.value)}};
}

}  // namespace

nlohmann::json makeBiscaleAll(const FigureRequest& request, Job& job) {
  FigurePage page;
  page.title = "Bi-Scale Radiance Transfer, made anew";
  nlohmann::json parts = nlohmann::json::array();
  for (const Part& part : kParts) {
    parts.push_back(makeFigure(part.name, {request.folder / part.name, request.mesh}, job));
    if (page.rows.empty() || page.rows.back().size() == 3) page.rows.emplace_back();
    const std::string in = std::string(part.name) + "/";
    page.rows.back().push_back({in + part.picture, part.text, in + "index.html"});
  }
  const BenchResult frames = runBench("biscale", job);
  const BenchResult pipeline =
      runPipelineBench(pipelineBenchRecipe(request.mesh.empty() ? "builtin:bird" : request.mesh), job);
  page.numbers = numbersOf(frames, pipeline);
  page.intro = "Figures and numbers of section 6, on this machine. A click on a picture shows the figure.";
  return {{"figure", "biscale"},
          {"page", writePage(request.folder, page)},
          {"parts", parts},
          {"numbers", {toJson(frames), toJson(pipeline)}}};
}

}  // namespace prt
