#include "libprt/gl/program.h"

#include "libprt/core/error.h"

#include <epoxy/gl.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <initializer_list>
#include <regex>
#include <sstream>

namespace prt::gl {

namespace {

const ShaderSource& embedded(const std::string& name) {
  const auto& all = embeddedShaders();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const ShaderSource& s) { return s.name == name; });
  if (found == all.end()) throw std::logic_error("no shader named " + name);
  return *found;
}

// The "#line" that follows each version line keeps the numbering.
std::string withPrelude(std::string text, const std::string& prelude) {
  return text.insert(text.find('\n') + 1, prelude);
}

std::string firstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

GLenum kindOf(const std::string& name) {
  return name.ends_with(".vert")   ? GL_VERTEX_SHADER
         : name.ends_with(".comp") ? GL_COMPUTE_SHADER
                                   : GL_FRAGMENT_SHADER;
}

// A compiled shader object, deleted with the scope; a linked program keeps what it needs.
class Shader {
 public:
  Shader(const ShaderSource& source, const std::string& prelude) : id_(glCreateShader(kindOf(source.name))) {
    const std::string text = withPrelude(source.text, prelude);
    const char* pointer = text.c_str();
    glShaderSource(id_, 1, &pointer, nullptr);
    glCompileShader(id_);
    GLint compiled = 0;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
    if (compiled) return;
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(id_, GLsizei(log.size()), &length, log.data());
    log.resize(std::size_t(length));
    glDeleteShader(id_);
    throw ResourceError(firstLine(readableLog(log, source.files)), source.name, "update the graphics driver");
  }
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint id() const { return id_; }

 private:
  GLuint id_;
};

void link(GLuint program, std::initializer_list<GLuint> shaders, const std::string& name) {
  for (const GLuint shader : shaders) glAttachShader(program, shader);
  glLinkProgram(program);
  for (const GLuint shader : shaders) glDetachShader(program, shader);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program, GLsizei(log.size()), &length, log.data());
  log.resize(std::size_t(length));
  throw ResourceError(firstLine(log), name, "update the graphics driver");
}

}  // namespace

std::string readableLog(const std::string& log, const std::vector<std::string>& files) {
  // Mesa "1:12(3): error", NVIDIA "1(12) : error", AMD and Intel "ERROR: 1:12: ".
  static const std::regex place(R"(^(ERROR: |WARNING: )?(\d+)[:(](\d+)(\(\d+\)|\))?\s*:\s*)");
  std::istringstream in(log);
  std::string out;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, place)) {
      const std::size_t file = std::stoul(match[2]);
      const std::string name = file < files.size() ? files[file] : "shader " + match[2].str();
      line = name + ":" + match[3].str() + ": " + match[1].str() + match.suffix().str();
    }
    out += line + "\n";
  }
  return out;
}

Program Program::fromLibrary(const std::string& vertex, const std::string& fragment,
                             const std::string& prelude) {
  return fromSources(embedded(vertex), embedded(fragment), prelude);
}

Program Program::fromSources(const ShaderSource& vertex, const ShaderSource& fragment,
                             const std::string& prelude) {
  const Shader vertexShader(vertex, prelude), fragmentShader(fragment, prelude);
  Program program(glCreateProgram());
  link(program.id_, {vertexShader.id(), fragmentShader.id()}, vertex.name + " + " + fragment.name);
  return program;
}

Program Program::compute(const std::string& name) {
  const Shader shader(embedded(name), {});
  Program program(glCreateProgram());
  link(program.id_, {shader.id()}, name);
  return program;
}

void Program::use() const {
  glUseProgram(id_);
}

int Program::location(const char* name) {
  const auto found = locations_.find(std::string_view(name));
  if (found != locations_.end()) return found->second;
  return locations_[name] = glGetUniformLocation(id_, name);
}

void Program::set(const char* name, int value) {
  glProgramUniform1i(id_, location(name), value);
}
void Program::set(const char* name, float value) {
  glProgramUniform1f(id_, location(name), value);
}
void Program::set(const char* name, const Vec2& value) {
  glProgramUniform2f(id_, location(name), value.x, value.y);
}
void Program::set(const char* name, const Vec3& value) {
  glProgramUniform3f(id_, location(name), value.x, value.y, value.z);
}
void Program::set(const char* name, const Vec4& value) {
  glProgramUniform4f(id_, location(name), value.x, value.y, value.z, value.w);
}
void Program::set(const char* name, const Mat3& value) {
  glProgramUniformMatrix3fv(id_, location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, const Mat4& value) {
  glProgramUniformMatrix4fv(id_, location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* name, std::span<const Vec2> values) {
  glProgramUniform2fv(id_, location(name), GLsizei(values.size()), glm::value_ptr(values.front()));
}
void Program::set(const char* name, std::span<const Vec3> values) {
  glProgramUniform3fv(id_, location(name), GLsizei(values.size()), glm::value_ptr(values.front()));
}

}  // namespace prt::gl
