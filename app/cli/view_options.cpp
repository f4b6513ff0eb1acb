#include "app/cli/view_options.h"

#include "libprt/core/file.h"
#include "libprt/core/image_io.h"
#include "libprt/light/sky_angles.h"
#include "libprt/project/lights.h"
#include "libprt/shade/tonemap.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace prt::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxSide = 16384;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

[[noreturn]] void badLight(const std::string& text, const std::string& problem) {
  throw UsageError(
      problem, "--light " + text,
      "write circle:DIR:DEG:RGB, directional:DIR:RGB or constant:RGB, as in circle:0,1,0:30:5,5,4");
}

std::vector<double> numbers(const std::string& list, const std::string& light) {
  std::vector<double> values;
  for (const std::string& part : split(list, ',')) {
    double value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(value))
      badLight(light, "'" + part + "' is not a number");
    values.push_back(value);
  }
  return values;
}

Vec3 parseDirection(const std::string& part, const std::string& light) {
  const std::vector<double> v = numbers(part, light);
  if (v.size() == 3 && (v[0] != 0 || v[1] != 0 || v[2] != 0)) return Vec3(normalize(DVec3(v[0], v[1], v[2])));
  if (v.size() != 2) badLight(light, "'" + part + "' is not a direction");
  return directionOf(SkyAngles{radians(v[0]), radians(v[1])});
}

Rgb colorOf(const std::string& part, const std::string& light) {
  const std::vector<double> v = numbers(part, light);
  if ((v.size() != 1 && v.size() != 3) || *std::min_element(v.begin(), v.end()) < 0)
    badLight(light, "'" + part + "' is not a colour");
  return v.size() == 1 ? Rgb(float(v[0])) : Rgb(float(v[0]), float(v[1]), float(v[2]));
}

std::vector<LightRecipe> lightsOf(const ViewOptions& options, const Recipe& recipe) {
  std::vector<LightRecipe> lights = recipe.lights;
  if (!options.environment.empty() || !options.lights.empty()) lights.clear();
  if (!options.environment.empty()) {
    LightRecipe& light = lights.emplace_back();
    light.path =
        isBuiltin(options.environment) ? options.environment : fs::absolute(options.environment).string();
  }
  for (const std::string& text : options.lights) lights.push_back(parseLight(text));
  if (options.rotate)
    for (LightRecipe& light : lights)
      if (light.kind == LightKind::Environment) light.rotation = float(*options.rotate);
  return lights;
}

std::string lowerExtension(const std::string& file) {
  std::string text = fs::path(file).extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

}  // namespace

void ViewOptions::addTo(CLI::App& command) {
  command.add_option("PROJECT", project, "Baked project (.prt)")->required();
  command.add_option("--env", environment,
                     "Environment instead of the project's lights: EXR, HDR, PNG or builtin:NAME");
  command
      .add_option("--rotate", rotate,
                  "Turn of the environment about +Y in degrees, counter-clockwise seen from above")
      ->check(finite());
  command
      .add_option("--light", lights,
                  "circle:DIR:DEG:RGB, directional:DIR:RGB or constant:RGB; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--camera", camera,
                     "Camera of the project by name, or a .json file; default: the first");
  command.add_option("--size", size, "Width x height in pixels")->capture_default_str();
  command.add_flag("--background", background, "Show the environment behind the scene");
  command.add_option("--exposure", exposure, "Stops, for PNG only")
      ->check(finite())
      ->check(CLI::Range(-30.0, 30.0))
      ->capture_default_str();
  command.add_option("-o,--output", output, "Picture to write: .exr, .hdr or .png")->required();
}

LightRecipe parseLight(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  LightRecipe light;
  light.name = text;
  if (parts[0] == "circle" && parts.size() == 4) {
    light.kind = LightKind::Circle;
    light.direction = parseDirection(parts[1], text);
    const std::vector<double> angle = numbers(parts[2], text);
    if (angle.size() != 1 || angle[0] <= 0 || angle[0] > 360)
      badLight(text, "'" + parts[2] + "' is not an angle of 0 to 360 degrees");
    light.angle = float(angle[0]);
  } else if (parts[0] == "directional" && parts.size() == 3) {
    light.kind = LightKind::Directional;
    light.direction = parseDirection(parts[1], text);
  } else if (parts[0] == "constant" && parts.size() == 2) {
    light.kind = LightKind::Constant;
  } else {
    badLight(text, "is not a light");
  }
  light.radiance = colorOf(parts.back(), text);
  return light;
}

void parseSize(const std::string& text, int& width, int& height) {
  const std::vector<std::string> parts = split(text, 'x');
  const auto side = [](const std::string& part, int& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size() && value >= 1 && value <= kMaxSide;
  };
  if (parts.size() != 2 || !side(parts[0], width) || !side(parts[1], height))
    throw UsageError("'" + text + "' is not a size", "--size",
                     "write for example 800x600, up to 16384 a side");
}

Camera parseCamera(const std::string& text, const Recipe& recipe) {
  std::vector<std::string> names;
  for (const CameraRecipe& camera : recipe.cameras) {
    if (camera.name == text) return camera.camera();
    names.push_back(camera.name);
  }
  std::error_code error;
  if (fs::exists(text, error) || lowerExtension(text) == ".json") {
    const std::vector<std::byte> bytes = readFile(text, 1 << 20);
    const auto* begin = reinterpret_cast<const char*>(bytes.data());
    const auto json = nlohmann::json::parse(begin, begin + bytes.size(), nullptr, false);
    if (json.is_discarded())
      throw FileError("is not JSON", text, R"(write {"eye": [x,y,z], "target": [x,y,z], "vfov_deg": 30})");
    return recipeFromJson({{"cameras", {json}}}, text).cameras.at(0).camera();
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "use " : ", ") + name;
  throw ValueError("there is no camera '" + text + "'", "--camera",
                   list.empty() ? "give a .json file" : list + " or a .json file");
}

View viewOf(const ViewOptions& options, const Recipe& recipe, const fs::path& folder, const Box3& bounds) {
  View view;
  parseSize(options.size, view.width, view.height);
  EnvironmentCache environments;
  const std::vector<LightRecipe> lights = lightsOf(options, recipe);
  view.lights = makeLightRig(lights, folder, environments);
  if (!options.camera.empty())
    view.camera = parseCamera(options.camera, recipe);
  else if (!recipe.cameras.empty())
    view.camera = recipe.cameras[0].camera();
  else
    view.camera = frameBox(bounds);
  return view;
}

void checkPictureOutput(const std::string& output) {
  const std::string extension = lowerExtension(output);
  if (extension != ".exr" && extension != ".png" && extension != ".hdr")
    throw UsageError("'" + output + "' is not a picture's name", "-o", "use .exr, .hdr or .png");
  const AtomicFile writable(output);
}

void writePicture(const std::string& output, const Image& radiance, double exposure) {
  if (lowerExtension(output) != ".png") return writeImage(output, radiance);
  ImageWriteOptions options;
  options.alreadySrgb = true;
  writeImage(output, toDisplay(radiance, {float(exposure), ToneCurve::Linear}), options);
}

}  // namespace prt::cli
