#include "libprt/gl/sh_glsl.h"

#include "libprt/basis/sh.h"

#include <fmt/format.h>

#include <cmath>

namespace prt::gl {

namespace {

// Normalised recurrences with sin^m(theta) factored out: q_mm, then q_(m+1)m, then up in l; times the real
// and imaginary parts C, S of (x + iy)^m (ALGORITHMS: Sloan 2013).
std::string evaluation(int bands) {
  std::string code = fmt::format("void shEvaluate(vec3 d, out float y[{}]) {{\n", shCount(bands));
  double diagonal = 0.5 / std::sqrt(kPi);
  for (int m = 0; m < bands; ++m) {
    if (m > 0) diagonal *= std::sqrt((2.0 * m + 1) / (2.0 * m));
    if (m == 1) code += "float c1 = d.x, s1 = d.y;\n";
    if (m > 1)
      code +=
          fmt::format("float c{0} = d.x * c{1} - d.y * s{1}, s{0} = d.x * s{1} + d.y * c{1};\n", m, m - 1);
    for (int l = m; l < bands; ++l) {
      const std::string q = fmt::format("q{}_{}", l, m);
      if (l == m) {
        code += fmt::format("float {} = {:.9e};\n", q, diagonal * (m > 0 ? std::sqrt(2.0) : 1));
      } else {
        const double a = std::sqrt((4.0 * l * l - 1) / (double(l) * l - double(m) * m));
        code += fmt::format("float {} = {:.9e} * d.z * q{}_{}", q, a, l - 1, m);
        if (l > m + 1) {
          const double b = std::sqrt(((l - 1.0) * (l - 1) - double(m) * m) / (4.0 * (l - 1) * (l - 1) - 1));
          code += fmt::format(" - {:.9e} * q{}_{}", a * b, l - 2, m);
        }
        code += ";\n";
      }
      if (m == 0)
        code += fmt::format("y[{}] = {};\n", shIndex(l, 0), q);
      else
        code +=
            fmt::format("y[{}] = {} * c{};\ny[{}] = {} * s{};\n", shIndex(l, m), q, m, shIndex(l, -m), q, m);
    }
  }
  return code + "}\n";
}

double cosineFactor(int l) {
  if (l == 1) return 2.0 / 3;
  if (l % 2 == 1) return 0;
  double factor = 1;
  for (int k = 2; k <= l; k += 2) factor *= -double(k - 3) / double(k + 2);
  return factor;
}

std::string countTo(int end) {
  std::string list;
  for (int i = 0; i < end; ++i) list += fmt::format(" F({})", i);
  return list;
}

}  // namespace

std::string shGlsl(int bands) {
  std::string functions, cosines;
  for (int l = 0; l < bands; ++l) {
    cosines += fmt::format("{}{:.9e}", l > 0 ? ", " : "", cosineFactor(l));
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) functions += fmt::format(" F({}, {})", i, l);
  }
  std::string code = fmt::format("#define BANDS {}\n#define FOR_EACH_FUNCTION(F){}\n", bands, functions);
  code += fmt::format("#define FOR_EACH_BAND_PAIR(F){}\n", countTo((bands + 1) / 2));
  code += fmt::format("#define FOR_EACH_LIGHT_SLOT(F){}\n", countTo((3 * shCount(bands) + 3) / 4));
  code += fmt::format("const int kFunctions = {};\n", shCount(bands));
  code += fmt::format("const float kCosine[BANDS] = float[]({});\n", cosines);
  return code + evaluation(bands);
}

}  // namespace prt::gl
