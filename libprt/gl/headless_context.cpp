#include "libprt/gl/headless_context.h"

#include "libprt/core/error.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <iterator>
#include <vector>

namespace prt::gl {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw ResourceError(what, "OpenGL without a display",
                      "install libegl1 and libgl1-mesa-dri, or render with the CPU");
}

// Displays without a screen: Mesa's, then the cards that drivers name (NVIDIA's on servers), then whatever
// EGL takes for the default.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> all;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    all.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
      epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (eglQueryDevicesEXT(EGLint(std::size(devices)), devices, &count))
      for (EGLint i = 0; i < count; ++i)
        all.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
  }
  all.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return all;
}

EGLDisplay startedDisplay() {
  if (!epoxy_has_egl()) fail("there is no EGL library");
  for (const EGLDisplay display : displays())
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  fail("EGL does not start");
}

EGLContext createContext(EGLDisplay display) {
  if (!eglBindAPI(EGL_OPENGL_API)) fail("EGL knows no desktop OpenGL");
  const EGLint configWanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, configWanted, &config, 1, &count) || count == 0)
    config = nullptr;  // EGL_NO_CONFIG
  const EGLint contextWanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, contextWanted);
}

}  // namespace

struct HeadlessContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

HeadlessContext::HeadlessContext() : impl_(std::make_unique<Impl>()) {
  impl_->display = startedDisplay();
  impl_->context = createContext(impl_->display);
  if (impl_->context == EGL_NO_CONTEXT) fail("the driver has no OpenGL 4.5");
  makeCurrent();
}

// The display is not terminated: another context of this process may live on it.
HeadlessContext::~HeadlessContext() {
  eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(impl_->display, impl_->context);
}

void HeadlessContext::makeCurrent() {
  if (!eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context))
    fail("the context cannot be made current");
}

std::string describeContext() {
  const auto text = [](GLenum name) {
    const GLubyte* value = glGetString(name);
    return value ? std::string(reinterpret_cast<const char*>(value)) : std::string("unknown");
  };
  return text(GL_VERSION) + ", " + text(GL_RENDERER);
}

bool contextIsSoftware() {
  const GLubyte* value = glGetString(GL_RENDERER);
  const std::string renderer = value ? reinterpret_cast<const char*>(value) : "";
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software", "SwiftShader"})
    if (renderer.find(name) != std::string::npos) return true;
  return false;
}

bool contextIsSufficient() {
  return epoxy_is_desktop_gl() && epoxy_gl_version() >= 45;
}

}  // namespace prt::gl
