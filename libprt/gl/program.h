#pragma once
// Shader programs made from the sources in shaders/, which are embedded in the library.

#include "libprt/gl/objects.h"

#include <map>
#include <string>
#include <vector>

namespace prt::gl {

/// One shader with its includes resolved; "#line" directives number the files as in `files`.
struct ShaderSource {
  std::string name;                ///< "mesh.frag": the ending tells the stage
  std::vector<std::string> files;  ///< files[0] is the shader itself
  std::string text;
};

/// Every shader of the library.
const std::vector<ShaderSource>& embeddedShaders();

/// A driver's message with its "file number : line" places turned into "mesh.frag:12".
std::string readableLog(const std::string& log, const std::vector<std::string>& files);

class Program : public detail::Handle<detail::deleteProgram> {
 public:
  Program() = default;
  /// Compiles and links a vertex and a fragment shader of the library, by name, with `prelude` in front of
  /// both, behind their version. Throws ResourceError that names file and line when the driver refuses.
  static Program fromLibrary(const std::string& vertex, const std::string& fragment,
                             const std::string& prelude = {});
  static Program fromSources(const ShaderSource& vertex, const ShaderSource& fragment,
                             const std::string& prelude = {});

  /// A compute shader of the library.
  static Program compute(const std::string& name);

  void use() const;
  /// Uniforms by name; one that the compiler dropped is ignored.
  void set(const char* name, int value);
  void set(const char* name, float value);
  void set(const char* name, const Vec2& value);
  void set(const char* name, const Vec3& value);
  void set(const char* name, const Vec4& value);
  void set(const char* name, const Mat3& value);
  void set(const char* name, const Mat4& value);
  void set(const char* name, std::span<const Vec2> values);
  void set(const char* name, std::span<const Vec3> values);

 private:
  using Handle::Handle;
  int location(const char* name);
  std::map<std::string, int, std::less<>> locations_;
};

}  // namespace prt::gl
