#include "libprt/gl/program.h"

#include "libprt/core/error.h"
#include "libprt/gl/sh_glsl.h"
#include "tests/gl/gl_test_support.h"
#include "tests/support/paths.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace prt::gl {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using ProgramTest = test::GlTest;

const ShaderSource& source(const std::string& name) {
  for (const ShaderSource& shader : embeddedShaders())
    if (shader.name == name) return shader;
  throw std::logic_error("no shader named " + name);
}

TEST_F(ProgramTest, EveryFragmentShaderOfTheLibraryCompiles) {
  int count = 0;
  for (const ShaderSource& shader : embeddedShaders()) {
    if (!shader.name.ends_with(".frag")) continue;
    const std::string own = shader.name.substr(0, shader.name.size() - 5) + ".vert";
    const bool paired = std::any_of(embeddedShaders().begin(), embeddedShaders().end(),
                                    [&](const ShaderSource& each) { return each.name == own; });
    const std::string vertex = paired ? own : "fullscreen.vert";
    for (const int bands : {1, 2, 5, 10})
      for (const char* variant : {"", "#define EVERYWHERE\n", "#define TEXELS\n"})
        EXPECT_NO_THROW(Program::fromLibrary(
            vertex, shader.name,
            shGlsl(bands) + "#define RESPONSE_ROWS 512\n#define SHADE_LEAST 0.5\n#define DARK_SQUARE 0.5\n" +
                variant))
            << shader.name << " with " << bands << " bands";
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST_F(ProgramTest, IncludesAreResolvedOnceAndLinesKeepTheirNumbers) {
  const ShaderSource& shader = source("mesh_irradiance.frag");
  EXPECT_EQ(shader.text.find("#include"), std::string::npos);
  EXPECT_EQ(shader.files.front(), "mesh_irradiance.frag");
  EXPECT_THAT(shader.files, testing::Contains("material.glsl"));

  // Every line of the embedded text is found at the place its #line directives claim.
  std::istringstream text(shader.text);
  std::size_t file = 0, line = 1;
  std::map<std::size_t, std::vector<std::string>> originals;
  for (std::size_t i = 0; i < shader.files.size(); ++i) {
    std::ifstream in(test::sourceFolder() / "shaders" / shader.files[i]);
    for (std::string original; std::getline(in, original);) originals[i].push_back(original);
  }
  for (std::string row; std::getline(text, row);) {
    if (row.starts_with("#line ")) {
      std::istringstream(row.substr(6)) >> line >> file;
      continue;
    }
    ASSERT_LE(line, originals[file].size());
    EXPECT_EQ(row, originals[file][line - 1]);
    ++line;
  }
}

TEST_F(ProgramTest, ACompileErrorNamesFileAndLine) {
  ShaderSource broken = source("mesh_irradiance.frag");
  const std::size_t at = broken.text.find("vec4 specular");
  ASSERT_NE(at, std::string::npos);
  broken.text.insert(at, "vec5 ");
  try {
    Program::fromSources(source("mesh_irradiance.vert"), broken);
    FAIL() << "a broken shader compiled";
  } catch (const ResourceError& error) {
    EXPECT_THAT(error.problem(), StartsWith("material.glsl:3: "));
    EXPECT_EQ(error.where(), "mesh_irradiance.frag");
  }
}

TEST_F(ProgramTest, MismatchedStagesDoNotLink) {
  const ShaderSource vertex{
      "a.vert",
      {"a.vert"},
      "#version 450 core\nout vec2 x;\nvoid main() { gl_Position = vec4(x = vec2(0), 0, 1); }\n"};
  const ShaderSource fragment{
      "b.frag", {"b.frag"}, "#version 450 core\nin vec4 x;\nout vec4 c;\nvoid main() { c = x; }\n"};
  EXPECT_THROW(Program::fromSources(vertex, fragment), ResourceError);
}

TEST(ReadableLog, KnowsTheDialectsOfTheDrivers) {
  const std::vector<std::string> files{"mesh.frag", "sh.glsl"};
  EXPECT_THAT(readableLog("1:12(3): error: no", files), HasSubstr("sh.glsl:12: error: no"));         // Mesa
  EXPECT_THAT(readableLog("0(7) : error C1008: no", files), HasSubstr("mesh.frag:7: error C1008"));  // NVIDIA
  EXPECT_THAT(readableLog("ERROR: 1:12: 'x' : no", files),
              HasSubstr("sh.glsl:12: ERROR: 'x'"));  // AMD, Intel
  EXPECT_THAT(readableLog("9:1(1): error: no", files), HasSubstr("shader 9:1"));
  EXPECT_THAT(readableLog("linking failed", files), StartsWith("linking failed"));
}

}  // namespace
}  // namespace prt::gl
