#pragma once
// The files of resources/scenes, as the build put them into the library. Internal to project/.

#include <span>

namespace prt {

struct EmbeddedScene {
  const char* name;
  const char* json;
};

std::span<const EmbeddedScene> embeddedScenes();

}  // namespace prt
