#pragma once
// An OpenGL 4.5 core context without a window or a display: EGL on Mesa's "surfaceless" platform or
// on a graphics card that its driver names, with Mesa's software driver where there is none.

#include <memory>
#include <string>

namespace prt::gl {

class HeadlessContext {
 public:
  /// Makes the context and makes it current on this thread. Throws ResourceError when the machine has
  /// no OpenGL 4.5.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  void makeCurrent();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Version and renderer of the current context, "4.5 (Core Profile) Mesa 22.3.6, llvmpipe".
std::string describeContext();
/// True when the current context can run prt_gl: OpenGL 4.5 core or newer.
bool contextIsSufficient();
/// True when the CPU draws: Mesa's llvmpipe and softpipe, and others of their kind.
bool contextIsSoftware();

}  // namespace prt::gl
