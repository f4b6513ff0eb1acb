#include "libprt/gl/objects.h"

#include "libprt/core/error.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

namespace prt::gl {

namespace detail {
void deleteBuffer(unsigned id) {
  glDeleteBuffers(1, &id);
}
void deleteVertexArray(unsigned id) {
  glDeleteVertexArrays(1, &id);
}
void deleteTexture(unsigned id) {
  glDeleteTextures(1, &id);
}
void deleteFramebuffer(unsigned id) {
  glDeleteFramebuffers(1, &id);
}
void deleteProgram(unsigned id) {
  glDeleteProgram(id);
}
}  // namespace detail

namespace {

constexpr std::size_t kGroup = 16;  // bytes of a buffer texture's texel

GLenum internalFormat(PixelFormat format) {
  switch (format) {
    case PixelFormat::Rgba8:
      return GL_RGBA8;
    case PixelFormat::Rgba16f:
      return GL_RGBA16F;
    case PixelFormat::Rgba32f:
      return GL_RGBA32F;
    case PixelFormat::R32f:
      return GL_R32F;
    case PixelFormat::Depth32f:
      return GL_DEPTH_COMPONENT32F;
  }
  return GL_NONE;
}

std::string errorName(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "error " + std::to_string(error);
  }
}

// Rows bottom up <-> rows top down.
void flipRows(Image& image) {
  const std::size_t row = std::size_t(image.width) * image.channels;
  for (int y = 0; y < image.height / 2; ++y)
    std::swap_ranges(image.pixel(0, y), image.pixel(0, y) + row, image.pixel(0, image.height - 1 - y));
}

}  // namespace

void finish() {
  glFinish();
}

void checkErrors(const char* where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw ResourceError("OpenGL reports " + errorName(error), where, "render with the CPU instead");
}

Buffer Buffer::create() {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  return Buffer(id);
}

void Buffer::uploadBytes(const void* data, std::size_t bytes, std::size_t spare) {
  glNamedBufferData(id_, GLsizeiptr(bytes + spare), nullptr, GL_DYNAMIC_DRAW);
  glNamedBufferSubData(id_, 0, GLsizeiptr(bytes), data);
  bytes_ = bytes;
}

void Buffer::bindStorage(unsigned binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id_);
}

VertexArray VertexArray::create() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return VertexArray(id);
}

void VertexArray::floats(unsigned location, const Buffer& buffer, int components) {
  glVertexArrayVertexBuffer(id_, location, buffer.id(), 0, GLsizei(components * sizeof(float)));
  glVertexArrayAttribFormat(id_, location, components, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(id_, location, location);
  glEnableVertexArrayAttrib(id_, location);
}

void VertexArray::integers(unsigned location, const Buffer& buffer) {
  glVertexArrayVertexBuffer(id_, location, buffer.id(), 0, sizeof(GLuint));
  glVertexArrayAttribIFormat(id_, location, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(id_, location, location);
  glEnableVertexArrayAttrib(id_, location);
}

void VertexArray::indices(const Buffer& buffer) {
  glVertexArrayElementBuffer(id_, buffer.id());
}

Texture Texture::create2d(int width, int height, PixelFormat format, int samples) {
  GLuint id = 0;
  glCreateTextures(samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, 1, &id);
  Texture texture(id);
  texture.width_ = width;
  texture.height_ = height;
  texture.samples_ = samples;
  if (samples > 1) {
    glTextureStorage2DMultisample(id, samples, internalFormat(format), width, height, GL_TRUE);
  } else {
    glTextureStorage2D(id, 1, internalFormat(format), width, height);
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  return texture;
}

Texture Texture::fromImage(const Image& image, Wrap wrap, bool mipmaps) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &id);
  Texture texture(id);
  texture.width_ = image.width;
  texture.height_ = image.height;
  const int levels = mipmaps ? std::bit_width(unsigned(std::max(image.width, image.height))) : 1;
  glTextureStorage2D(id, levels, GL_RGBA32F, image.width, image.height);
  const GLenum layouts[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTextureSubImage2D(id, 0, 0, 0, image.width, image.height, layouts[image.channels - 1], GL_FLOAT,
                      image.data.data());
  if (mipmaps) glGenerateTextureMipmap(id);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, wrap == Wrap::RepeatX ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Texture Texture::integers(const void* values, unsigned format, unsigned components, unsigned type, int width,
                          int height) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &id);
  Texture texture(id);
  texture.width_ = width;
  texture.height_ = height;
  glTextureStorage2D(id, 1, format, width, height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
  glTextureSubImage2D(id, 0, 0, 0, width, height, components, type, values);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

Texture Texture::fromIntegers(std::span<const std::uint16_t> values, int components, int width, int height) {
  const bool pairs = components == 2;
  return integers(values.data(), pairs ? GL_RG16UI : GL_R16UI, pairs ? GL_RG_INTEGER : GL_RED_INTEGER,
                  GL_UNSIGNED_SHORT, width, height);
}

Texture Texture::fromBytes(std::span<const std::uint8_t> values, int width, int height) {
  return integers(values.data(), GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, width, height);
}

void Texture::bind(unsigned unit) const {
  glBindTextureUnit(unit, id_);
}

BufferTexture BufferTexture::create(Format format) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
  BufferTexture texture(id);
  texture.buffer_ = Buffer::create();
  texture.buffer_.upload(std::span<const std::uint32_t>(), kGroup);  // a name without storage is no buffer
  glTextureBuffer(id, format == Format::Floats ? GL_RGBA32F : GL_RGBA32UI, texture.buffer_.id());
  return texture;
}

void BufferTexture::uploadBytes(const void* data, std::size_t bytes, const char* what) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (bytes / kGroup > std::size_t(most))
    throw ResourceError(std::to_string(bytes / 1000000) + " MB are more than OpenGL takes here", what,
                        "render with the CPU instead");
  buffer_.upload(std::span(static_cast<const std::byte*>(data), bytes), kGroup);
}

void BufferTexture::bind(unsigned unit) const {
  glBindTextureUnit(unit, id_);
}

Framebuffer Framebuffer::create(int width, int height, PixelFormat colour, bool depth, int samples) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  Framebuffer framebuffer(id);
  framebuffer.colour_ = Texture::create2d(width, height, colour, samples);
  glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, framebuffer.colour_.id(), 0);
  if (depth) {
    framebuffer.depth_ = Texture::create2d(width, height, PixelFormat::Depth32f, samples);
    glNamedFramebufferTexture(id, GL_DEPTH_ATTACHMENT, framebuffer.depth_.id(), 0);
  }
  if (glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw ResourceError(
        "no render target of " + std::to_string(width) + " x " + std::to_string(height) + " pixels", "OpenGL",
        "use a smaller picture or fewer samples per pixel");
  return framebuffer;
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, width(), height());
}

Image Framebuffer::read() const {
  Image image(width(), height(), 4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_FLOAT, image.data.data());
  flipRows(image);
  return image;
}

void beginSurfaces() {
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace prt::gl
