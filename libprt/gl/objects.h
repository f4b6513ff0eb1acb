#pragma once
// Move-only owners of OpenGL 4.5 objects. All of them need a current context, at destruction too.
// No GL header is needed to use them: handles are plain unsigned numbers.

#include "libprt/core/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace prt::gl {

namespace detail {
void deleteBuffer(unsigned id);
void deleteVertexArray(unsigned id);
void deleteTexture(unsigned id);
void deleteFramebuffer(unsigned id);
void deleteProgram(unsigned id);

/// Owns one object name; 0 is "none".
template <void (*destroy)(unsigned)>
class Handle {
 public:
  Handle() = default;
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_) destroy(id_);
  }
  unsigned id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 protected:
  explicit Handle(unsigned id) : id_(id) {}
  unsigned id_ = 0;
};
}  // namespace detail

/// Throws ResourceError naming `where` when OpenGL has recorded an error since the last call.
void checkErrors(const char* where);

/// Returns when all that was asked for is drawn.
void finish();

/// Bytes on the GPU: vertices, indices or storage for shaders.
class Buffer : public detail::Handle<detail::deleteBuffer> {
 public:
  Buffer() = default;
  static Buffer create();

  /// Replaces the contents. What the GPU still reads is left alone (the driver renames the storage).
  /// `spare`: bytes of no meaning behind them, for shaders that read in groups.
  template <class T>
  void upload(std::span<const T> values, std::size_t spare = 0) {
    uploadBytes(values.data(), values.size_bytes(), spare);
  }
  std::size_t bytes() const { return bytes_; }
  /// Makes the buffer readable by shaders as storage block `binding`.
  void bindStorage(unsigned binding) const;

 private:
  using Handle::Handle;
  void uploadBytes(const void* data, std::size_t bytes, std::size_t spare);
  std::size_t bytes_ = 0;
};

/// Which buffer feeds which vertex attribute.
class VertexArray : public detail::Handle<detail::deleteVertexArray> {
 public:
  VertexArray() = default;
  static VertexArray create();

  /// Attribute `location` reads `components` tightly packed floats per vertex.
  void floats(unsigned location, const Buffer& buffer, int components);
  /// Attribute `location` reads one 32-bit unsigned integer per vertex.
  void integers(unsigned location, const Buffer& buffer);
  void indices(const Buffer& buffer);

 private:
  using Handle::Handle;
};

enum class PixelFormat { Rgba8, Rgba16f, Rgba32f, R32f, Depth32f };
enum class Wrap { Clamp, RepeatX };

class Texture : public detail::Handle<detail::deleteTexture> {
 public:
  Texture() = default;
  /// samples > 1 makes a multisampled texture, for rendering into; it cannot be filtered.
  static Texture create2d(int width, int height, PixelFormat format, int samples = 1);
  /// A float image as RGBA32F with linear filtering; `mipmaps` adds the whole chain.
  static Texture fromImage(const Image& image, Wrap wrap, bool mipmaps);
  /// One or two 16-bit unsigned integers a texel, [height][width][components], as they are; the first row is
  /// row 0.
  static Texture fromIntegers(std::span<const std::uint16_t> values, int components, int width, int height);
  /// Four bytes a texel, [height][width][4], as unsigned integers.
  static Texture fromBytes(std::span<const std::uint8_t> values, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  void bind(unsigned unit) const;

 private:
  using Handle::Handle;
  static Texture integers(const void* values, unsigned format, unsigned components, unsigned type, int width,
                          int height);
  int width_ = 0, height_ = 0, samples_ = 1;
};

/// A buffer that shaders read as a texture of groups of four 32-bit numbers: it may be far larger than a
/// storage block.
class BufferTexture : public detail::Handle<detail::deleteTexture> {
 public:
  enum class Format { Floats, Integers };

  BufferTexture() = default;
  static BufferTexture create(Format format);

  /// Replaces the contents; bytes beyond the last whole group are left out. Throws ResourceError when they
  /// are more than the driver takes, naming `what`.
  template <class T>
  void upload(std::span<const T> values, const char* what) {
    uploadBytes(values.data(), values.size_bytes(), what);
  }
  void bind(unsigned unit) const;
  /// For shaders that write it.
  void bindStorage(unsigned binding) const { buffer_.bindStorage(binding); }

 private:
  using Handle::Handle;
  void uploadBytes(const void* data, std::size_t bytes, const char* what);
  Buffer buffer_;
};

/// A render target with one colour texture and, if wanted, a depth texture.
class Framebuffer : public detail::Handle<detail::deleteFramebuffer> {
 public:
  Framebuffer() = default;
  static Framebuffer create(int width, int height, PixelFormat colour, bool depth, int samples = 1);

  const Texture& colour() const { return colour_; }
  /// Only when made with depth.
  const Texture& depth() const { return depth_; }
  int width() const { return colour_.width(); }
  int height() const { return colour_.height(); }
  int samples() const { return colour_.samples(); }
  /// Draws go here from now on, over the whole target.
  void bind() const;
  /// The colours as a float RGBA image, rows from the top. Single-sampled targets only.
  Image read() const;

 private:
  using Handle::Handle;
  Texture colour_, depth_;
};

/// Clears the bound framebuffer to nothing at the far end, and sets what drawing opaque surfaces with a depth
/// test needs, whatever was set before.
void beginSurfaces();

}  // namespace prt::gl
