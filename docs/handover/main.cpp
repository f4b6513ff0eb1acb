// Relights an exported project in a shader: light coefficients in, picture out.
//   handover GLTF_FOLDER NPY_FOLDER OUT.ppm [--size WxH] [--camera NAME] [--lamp X,Y,Z,DEGREES,RADIANCE]
// Without --lamp the light is the project's own. The numbers behind this are explained in docs/handover.md.

#include "exported.h"
#include "headless.h"
#include "light.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int kGrid = 2;  // samples per pixel and side, as prt relight takes them

struct Options {
  std::string gltf, npy, output, camera;
  int width = 800, height = 600;
  std::optional<std::array<float, 5>> lamp;  // direction, degrees across, radiance
};

Options parse(int argc, char** argv) {
  Options options;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const char* value = i + 1 < argc ? argv[i + 1] : "";
    std::array<float, 5> lamp{};
    if (word == "--size" && std::sscanf(value, "%dx%d", &options.width, &options.height) == 2)
      ++i;
    else if (word == "--camera")
      options.camera = value, ++i;
    else if (word == "--lamp" &&
             std::sscanf(value, "%f,%f,%f,%f,%f", &lamp[0], &lamp[1], &lamp[2], &lamp[3], &lamp[4]) == 5)
      options.lamp = lamp, ++i;
    else
      words.push_back(word);
  }
  if (words.size() != 3 || options.width < 1 || options.height < 1)
    throw std::runtime_error(
        "usage: handover GLTF_FOLDER NPY_FOLDER OUT.ppm [--size WxH] [--camera NAME] [--lamp "
        "X,Y,Z,DEGREES,RADIANCE]");
  options.gltf = words[0], options.npy = words[1], options.output = words[2];
  return options;
}

// ---- vectors and the camera ----

Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
float dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3 unit(const Vec3& v) {
  const float size = std::sqrt(dot(v, v));
  return {v[0] / size, v[1] / size, v[2] / size};
}

/// Column by column. Right-handed, looking down -z; near and far hold the whole mesh.
std::array<float, 16> worldToClip(const Camera& camera, float aspect, const std::vector<Vec3>& positions) {
  const Vec3 back = unit(minus(camera.eye, camera.target)), right = unit(cross(camera.up, back)),
             up = cross(back, right);
  float nearest = 1e30f, farthest = 0;
  for (const Vec3& p : positions) {
    const float depth = -dot(minus(p, camera.eye), back);
    nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
  }
  farthest *= 1.01f;
  nearest = std::max(0.99f * nearest, 1e-3f * farthest);
  const float y = 1 / std::tan(0.5f * camera.verticalFovDegrees * 3.14159265f / 180), x = y / aspect;
  const float a = (farthest + nearest) / (nearest - farthest),
              b = 2 * farthest * nearest / (nearest - farthest);
  std::array<float, 16> m{};
  for (std::size_t i = 0; i < 3; ++i)
    m[4 * i] = x * right[i], m[4 * i + 1] = y * up[i], m[4 * i + 2] = a * back[i], m[4 * i + 3] = -back[i];
  m[12] = -x * dot(right, camera.eye), m[13] = -y * dot(up, camera.eye);
  m[14] = -a * dot(back, camera.eye) + b, m[15] = dot(back, camera.eye);
  return m;
}

// ---- light ----

std::vector<Vec3> lightOf(const Exported& scene, const Options& options) {
  if (options.lamp) {
    const auto [x, y, z, degrees, radiance] = *options.lamp;
    const Vec3 towards = unit({x, y, z});
    const float edge = std::cos(0.5f * degrees * 3.14159265f / 180);
    return projectLight(scene.bands, [&](const Vec3& from) {
      return dot(from, towards) >= edge ? Vec3{radiance, radiance, radiance} : Vec3{};
    });
  }
  std::vector<Vec3> light(std::size_t(scene.bands * scene.bands));
  for (std::size_t i = 0; i < light.size(); ++i)
    std::copy_n(scene.light.floats() + 3 * i, 3, light[i].begin());
  return light;
}

// ---- OpenGL ----

template <class T>
unsigned bufferOf(const std::vector<T>& values) {
  unsigned buffer = 0;
  const T none{};
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, GLsizeiptr(std::max<std::size_t>(1, values.size()) * sizeof(T)),
                       values.empty() ? &none : values.data(), 0);
  return buffer;
}

void attribute(unsigned array, unsigned index, int components, unsigned buffer) {
  glVertexArrayVertexBuffer(array, index, buffer, 0, GLsizei(components * int(sizeof(float))));
  glVertexArrayAttribFormat(array, index, components, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array, index, index);
  glEnableVertexArrayAttrib(array, index);
}

unsigned uploadMesh(const Mesh& mesh) {
  unsigned array = 0;
  glCreateVertexArrays(1, &array);
  attribute(array, 0, 3, bufferOf(mesh.positions));
  attribute(array, 1, 3, bufferOf(mesh.normals));
  attribute(array, 2, 1, bufferOf(mesh.vertex));
  glVertexArrayElementBuffer(array, bufferOf(mesh.indices));
  return array;
}

unsigned uploadTransfer(const Exported& scene) {
  const auto channels = [](const Npy& array, std::size_t gray) {
    return array.shape.size() > gray ? " 3\n" : " 1\n";
  };
  std::string defines =
      "#define BANDS " + std::to_string(scene.bands) + "\n#define FUNCTIONS (BANDS * BANDS)\n";
  defines += std::string("#define DIFFUSE_CHANNELS") + channels(scene.transferDiffuse, 2);
  if (scene.full) {
    defines += std::string("#define FULL\n#define TRANSFER_CHANNELS") + channels(scene.transfer, 3);
    defines +=
        "#define ROWS " + std::to_string(scene.response.shape.empty() ? 1 : scene.response.shape[1]) + "\n";
  }
  std::ifstream file(SHADERS "/sh.glsl");
  defines += std::string(std::istreambuf_iterator<char>(file), {});
  unsigned binding = 0;
  for (const Npy* array : {&scene.albedo, &scene.transferDiffuse, &scene.transfer, &scene.object,
                           &scene.specular, &scene.response})
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, bufferOf(array->words));
  return makeProgram(SHADERS "/relight.vert", SHADERS "/relight.frag", defines);
}

/// A target of float radiance.
unsigned target(int width, int height) {
  unsigned frame = 0, buffers[2] = {};
  glCreateFramebuffers(1, &frame);
  glCreateRenderbuffers(2, buffers);
  glNamedRenderbufferStorage(buffers[0], GL_RGBA32F, width, height);
  glNamedRenderbufferStorage(buffers[1], GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferRenderbuffer(frame, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
  glNamedFramebufferRenderbuffer(frame, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
  if (glCheckNamedFramebufferStatus(frame, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the driver has no float target");
  return frame;
}

std::vector<float> draw(const Exported& scene, const Camera& camera, const std::vector<Vec3>& light,
                        int width, int height) {
  const unsigned array = uploadMesh(scene.mesh), program = uploadTransfer(scene);
  glBindFramebuffer(GL_FRAMEBUFFER, target(width, height));
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glUseProgram(program);
  glBindVertexArray(array);
  const std::array<float, 16> matrix =
      worldToClip(camera, float(width) / float(height), scene.mesh.positions);
  glUniformMatrix4fv(glGetUniformLocation(program, "worldToClip"), 1, GL_FALSE, matrix.data());
  glUniform3fv(glGetUniformLocation(program, "eye"), 1, camera.eye.data());
  // All that changes when the light does:
  glUniform3fv(glGetUniformLocation(program, "light"), GLsizei(light.size()), light[0].data());
  glDrawElements(GL_TRIANGLES, GLsizei(scene.mesh.indices.size()), GL_UNSIGNED_INT, nullptr);

  std::vector<float> pixels(4 * std::size_t(width) * std::size_t(height));
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
  if (const unsigned error = glGetError()) throw std::runtime_error("OpenGL error " + std::to_string(error));
  return pixels;
}

/// Mean of kGrid x kGrid samples, encoded as sRGB, from the top row down.
void writePpm(const std::string& file, const std::vector<float>& samples, int width, int height) {
  const auto encode = [](float v) {
    v = std::clamp(v, 0.0f, 1.0f);
    return char(std::lround(255 * (v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f)));
  };
  std::ofstream out(file, std::ios::binary);
  out << "P6\n" << width << ' ' << height << "\n255\n";
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        float sum = 0;
        for (int i = 0; i < kGrid * kGrid; ++i) {
          const int row = y * kGrid + i / kGrid, column = x * kGrid + i % kGrid;
          sum += samples[4 * (std::size_t(row) * std::size_t(width * kGrid) + std::size_t(column)) +
                         std::size_t(channel)];
        }
        out.put(encode(sum / float(kGrid * kGrid)));
      }
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

void run(const Options& options) {
  const Exported scene = readExported(options.gltf, options.npy);
  const auto camera = std::find_if(scene.cameras.begin(), scene.cameras.end(), [&](const Camera& c) {
    return options.camera.empty() || c.name == options.camera;
  });
  if (camera == scene.cameras.end()) throw std::runtime_error("there is no camera '" + options.camera + "'");
  makeHeadlessContext();
  const std::vector<float> samples =
      draw(scene, *camera, lightOf(scene, options), kGrid * options.width, kGrid * options.height);
  writePpm(options.output, samples, options.width, options.height);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "handover: %s\n", error.what());
    return 1;
  }
}
