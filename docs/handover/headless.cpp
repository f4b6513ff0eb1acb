#include "headless.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <fstream>
#include <stdexcept>

void makeHeadlessContext() {
  EGLDisplay display = EGL_NO_DISPLAY;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           4,
                           EGL_CONTEXT_MINOR_VERSION,
                           5,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
  EGLContext context = EGL_NO_CONTEXT;
  if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) && eglBindAPI(EGL_OPENGL_API))
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    throw std::runtime_error("OpenGL 4.5 without a window is not to be had here");
}

namespace {

unsigned compile(unsigned kind, const std::string& file, const std::string& prelude) {
  std::ifstream in(file);
  const std::string text =
      "#version 450 core\n" + prelude + "#line 1\n" + std::string(std::istreambuf_iterator<char>(in), {});
  const char* source = text.c_str();
  const unsigned shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  int compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  char log[4096] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  throw std::runtime_error(file + ": " + log);
}

}  // namespace

unsigned makeProgram(const std::string& vertexFile, const std::string& fragmentFile,
                     const std::string& prelude) {
  const unsigned program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, vertexFile, prelude));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragmentFile, prelude));
  glLinkProgram(program);
  int linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  char log[4096] = "";
  glGetProgramInfoLog(program, sizeof log, nullptr, log);
  throw std::runtime_error(vertexFile + ": " + log);
}
