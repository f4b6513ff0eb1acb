#pragma once
// Options that relight and reference share: light, camera, size, what to write.

#include "app/cli/session.h"
#include "libprt/core/image.h"
#include "libprt/light/light_rig.h"
#include "libprt/project/recipe.h"
#include "libprt/shade/camera.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace prt::cli {

struct ViewOptions {
  std::string project;
  std::string environment;
  std::optional<double> rotate;
  std::vector<std::string> lights;
  std::string camera;
  std::string size = "800x600";
  bool background = false;
  double exposure = 0;
  std::string output;

  /// Adds the options to a subcommand.
  void addTo(CLI::App& command);
};

/// The view that the options ask of a project.
struct View {
  LightRig lights;
  Camera camera;
  int width = 0;
  int height = 0;
};

/// Checks what can be checked before long work begins: sizes, names, that the output can be written.
/// `bounds` frames the scene where no camera is named. Throws UsageError for options that make no sense.
View viewOf(const ViewOptions& options, const Recipe& recipe, const std::filesystem::path& folder,
            const Box3& bounds);

/// "circle:DIR:DEG:RGB", "directional:DIR:RGB" or "constant:RGB"; DIR = "x,y,z" towards the light or
/// "azimuth,elevation" in degrees, RGB = "r,g,b" or one number. Throws UsageError.
LightRecipe parseLight(const std::string& text);
/// "800x600".
void parseSize(const std::string& text, int& width, int& height);
/// A camera of the recipe by name, or a JSON file.
Camera parseCamera(const std::string& text, const Recipe& recipe);

/// Throws UsageError unless a file of this name can be written as a picture; FileError where it cannot be
/// put.
void checkPictureOutput(const std::string& output);
/// Writes a picture: EXR and HDR as radiance, PNG tone-mapped with the exposure.
void writePicture(const std::string& output, const Image& radiance, double exposure);

}  // namespace prt::cli
