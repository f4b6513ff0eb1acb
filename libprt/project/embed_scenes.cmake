# Writes embedded_scenes.cpp from resources/scenes/*.json; runs again whenever one of them changes.
set(PRT_SCENE_FOLDER ${PROJECT_SOURCE_DIR}/resources/scenes)
file(GLOB PRT_SCENE_FILES CONFIGURE_DEPENDS ${PRT_SCENE_FOLDER}/*.json)
set(PRT_SCENE_ENTRIES "")
foreach(file ${PRT_SCENE_FILES})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND PRT_SCENE_ENTRIES "    {\"${name}\", R\"json(${text})json\"},\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded_scenes.cpp @ONLY CONTENT
"// Written by embed_scenes.cmake.
#include \"libprt/project/embedded_scenes.h\"

namespace prt {

std::span<const EmbeddedScene> embeddedScenes() {
  static const EmbeddedScene scenes[] = {
@PRT_SCENE_ENTRIES@  };
  return scenes;
}

}  // namespace prt
")
