#include "libprt/gl/surface_overlay.h"

#include "libprt/core/error.h"
#include "libprt/gl/surface_view.h"
#include "libprt/shade/color_map.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>
#include <vector>

namespace prt::gl {

namespace {

constexpr unsigned kPlacesBinding = 0;
enum PaintBinding : unsigned { kPositions, kNormals, kCorners, kColors, kCoordinates };
constexpr int kScaleUnit = 0, kOneSampleUnit = 1, kManySamplesUnit = 2, kMarksUnit = 3, kPictureUnit = 4;

void fit(Framebuffer& target, const OverlayPicture& picture, PixelFormat format, bool depth, int samples) {
  if (target && target.width() == picture.width && target.height() == picture.height &&
      target.samples() == samples)
    return;
  target = Framebuffer::create(picture.width, picture.height, format, depth, samples);
}

}  // namespace

SurfaceOverlay::SurfaceOverlay()
    : surfaceProgram_(Program::fromLibrary("overlay_surface.vert", "overlay_surface.frag",
                                           "#define SHADE_LEAST " + std::to_string(overlayShade(0)) + "\n")),
      paintProgram_(Program::fromLibrary("overlay_paint.vert", "overlay_paint.frag",
                                         "#define SHADE_LEAST " + std::to_string(overlayShade(0)) +
                                             "\n#define DARK_SQUARE " + std::to_string(kDarkSquare) + "\n")),
      marksProgram_(Program::fromLibrary("overlay_marks.vert", "overlay_marks.frag")),
      composeProgram_(Program::fromLibrary("fullscreen.vert", "overlay_compose.frag")),
      meshArray_(VertexArray::create()),
      emptyArray_(VertexArray::create()) {
  for (Buffer* buffer : {&positions_, &normals_, &values_, &indices_, &paintColors_, &paintUv_})
    *buffer = Buffer::create();
  const auto colors = magnitudeColors();
  Image scale(int(colors.size()), 1, 4);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (int c = 0; c < 3; ++c) scale.data[4 * i + std::size_t(c)] = colors[i][c];
    scale.data[4 * i + 3] = 1;
  }
  scale_ = Texture::fromImage(scale, Wrap::Clamp, false);
  surfaceProgram_.set("scale", kScaleUnit);
  surfaceProgram_.set("unknown", kUnknownColor);
  paintProgram_.set("picture", kPictureUnit);
  marksProgram_.set("surfaceDepth", kOneSampleUnit);
  marksProgram_.set("surfaceDepths", kManySamplesUnit);
  composeProgram_.set("surface", kOneSampleUnit);
  composeProgram_.set("surfaces", kManySamplesUnit);
  composeProgram_.set("marks", kMarksUnit);
  checkErrors("start of the overlay");
}

void SurfaceOverlay::setMesh(const TriMesh& mesh) {
  vertexCount_ = mesh.vertexCount();
  indexCount_ = int(3 * mesh.triangleCount());
  bounds_ = mesh.bounds();
  positions_.upload(std::span<const Vec3>(mesh.positions));
  normals_.upload(std::span<const Vec3>(mesh.normals));
  indices_.upload(std::span<const UVec3>(mesh.triangles));
  setValues({});
  setPaint({});
  meshArray_.floats(0, positions_, 3);
  meshArray_.floats(1, normals_, 3);
  meshArray_.floats(2, values_, 1);
  meshArray_.indices(indices_);
  checkErrors("upload of the overlay's mesh");
}

void SurfaceOverlay::setValues(std::span<const float> values) {
  if (!values.empty() && values.size() != vertexCount_)
    throw ValueError("an overlay of " + std::to_string(values.size()) + " values for a mesh of " +
                         std::to_string(vertexCount_) + " vertices",
                     "overlay", "give one value for each vertex");
  hasValues_ = !values.empty();
  const std::vector<float> none(hasValues_ ? 0 : vertexCount_, 0.0f);
  values_.upload(hasValues_ ? values : std::span<const float>(none));
}

void SurfaceOverlay::setPaint(const SurfacePaint& paint) {
  checkPaint(paint, std::size_t(indexCount_) / 3);
  hasPaint_ = paint.covers();
  pictured_ = paint.picture != nullptr;
  picture_ = pictured_ ? Texture::fromImage(*paint.picture, Wrap::Clamp, false) : Texture();
  squares_ = pictured_ ? 1 : hasPaint_ && !paint.uv.empty() ? paint.squares : 0;
  if (!paint.colors.empty()) paintColors_.upload(std::span<const Rgb>(paint.colors));
  if (squares_ > 0) paintUv_.upload(std::span<const Vec2>(paint.uv));
  seams_.upload(paint.seams);
}

void SurfaceOverlay::setMarks(std::span<const SurfaceMarks> marks) {
  marks_.resize(marks.size());
  marked_ = false;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    marks_[i].upload(marks[i]);
    marked_ = marked_ || !marks[i].empty();
  }
}

SurfaceOverlay::Uploaded::Uploaded() {
  for (Buffer* buffer : {&points, &edges, &triangles}) *buffer = Buffer::create();
}

void SurfaceOverlay::Uploaded::upload(const SurfaceMarks& marks) {
  pointCount = int(marks.points.size());
  edgeCount = int(marks.edges.size() / 2);
  triangleCount = int(marks.triangles.size() / 3);
  points.upload(std::span<const Vec3>(marks.points));
  edges.upload(std::span<const Vec3>(marks.edges));
  triangles.upload(std::span<const Vec3>(marks.triangles));
  color = marks.color;
  hidden = marks.hidden, size = marks.size, fill = marks.fill;
}

void SurfaceOverlay::draw(const OverlayPicture& picture, unsigned framebuffer) {
  if (empty() || picture.width < 1 || picture.height < 1) return;
  const int samples = supportedSamples(picture.grid * picture.grid);
  drawSurface(picture, samples);
  bool showSurface = hasValues_ || hasPaint_;
  // One layer of marks after the other; the surface's colours lie under the first.
  std::vector<const Uploaded*> layers{&seams_};
  for (const Uploaded& each : marks_) layers.push_back(&each);
  for (const Uploaded* each : layers) {
    if (each->empty() && !showSurface) continue;
    drawMarks(picture, *each);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, picture.width, picture.height);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    compose(samples, showSurface, each->color);
    glDisable(GL_BLEND);
    showSurface = false;
  }
  glBindVertexArray(0);
  glUseProgram(0);
  checkErrors("drawing the overlay");
}

Image SurfaceOverlay::render(const OverlayPicture& picture) {
  const Framebuffer target = Framebuffer::create(picture.width, picture.height, PixelFormat::Rgba32f, false);
  target.bind();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  draw(picture, target.id());
  return target.read();
}

void SurfaceOverlay::drawSurface(const OverlayPicture& picture, int samples) {
  fit(surface_, picture, PixelFormat::Rgba8, true, samples);
  surface_.bind();
  beginSurfaces();
  if (indexCount_ == 0) return;
  if (hasPaint_) {
    setView(paintProgram_, picture);
    paintProgram_.set("squares", squares_);
    paintProgram_.set("pictured", pictured_ ? 1 : 0);
    if (pictured_) picture_.bind(kPictureUnit);
    positions_.bindStorage(kPositions);
    normals_.bindStorage(kNormals);
    indices_.bindStorage(kCorners);
    if (!pictured_) paintColors_.bindStorage(kColors);
    if (squares_ > 0) paintUv_.bindStorage(kCoordinates);
    paintProgram_.use();
    glBindVertexArray(emptyArray_.id());
    glDrawArrays(GL_TRIANGLES, 0, indexCount_);
    return;
  }
  setView(surfaceProgram_, picture);
  scale_.bind(kScaleUnit);
  surfaceProgram_.use();
  glBindVertexArray(meshArray_.id());
  glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
}

void SurfaceOverlay::setView(Program& program, const OverlayPicture& picture) const {
  program.set("worldToClip", surfaceView(picture.camera, bounds_, picture.width, picture.height).worldToClip);
  program.set("eye", picture.camera.eye);
  program.set("axis", picture.camera.axes().normal);
  program.set("parallel", picture.camera.orthographic ? 1 : 0);
}

// The strongest mark in each pixel: the order of marks does not matter, and what overlaps does not add up.
void SurfaceOverlay::drawMarks(const OverlayPicture& picture, const Uploaded& marks) {
  fit(cover_, picture, PixelFormat::Rgba8, false, 1);
  cover_.bind();
  glDisable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendEquation(GL_MAX);
  const Vec2 depth = depthRange(picture.camera, bounds_);
  const Mat4 projection =
      picture.camera.projection(float(picture.width) / float(picture.height), depth.x, depth.y);
  surface_.depth().bind(surface_.samples() > 1 ? kManySamplesUnit : kOneSampleUnit);
  marksProgram_.set("samples", surface_.samples());
  marksProgram_.set("worldToClip", projection * picture.camera.view());
  marksProgram_.set("size", Vec2(picture.width, picture.height));
  marksProgram_.set("depthTerms", Vec3(projection[2][2], projection[3][2], projection[2][3]));
  marksProgram_.set("fill", marks.fill);
  marksProgram_.set("hidden", marks.hidden);
  const Camera& camera = picture.camera;
  marksProgram_.set("lift", camera.orthographic ? 0.0f : kMarkLift);
  marksProgram_.set("slack", camera.orthographic ? kMarkLift * length(camera.eye - camera.target) : 0.0f);
  const float scale = picture.pixelScale * marks.size;
  drawMarks(scale, marks.triangles, 3, marks.triangleCount);
  drawMarks(scale, marks.edges, 2, marks.edgeCount);
  drawMarks(scale, marks.points, 1, marks.pointCount);
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_BLEND);
}

void SurfaceOverlay::drawMarks(float pixelScale, const Buffer& places, int corners, int count) {
  if (count == 0) return;
  const float halfWidth = (corners == 1 ? kMarkRadius : kMarkHalfWidth) * pixelScale;
  marksProgram_.set("corners", corners);
  marksProgram_.set("halfWidth", halfWidth);
  marksProgram_.set("reach", halfWidth + kMarkOutline * pixelScale);
  places.bindStorage(kPlacesBinding);
  marksProgram_.use();
  glBindVertexArray(emptyArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, count * (corners == 3 ? 3 : 6));
}

void SurfaceOverlay::compose(int samples, bool showSurface, const Rgb& markColor) {
  surface_.colour().bind(samples > 1 ? kManySamplesUnit : kOneSampleUnit);
  cover_.colour().bind(kMarksUnit);
  composeProgram_.set("samples", samples);
  composeProgram_.set("showSurface", showSurface ? 1 : 0);
  composeProgram_.set("markColour", markColor);
  composeProgram_.use();
  glBindVertexArray(emptyArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace prt::gl
