// Body of the matrix kernels: included by two sources that are compiled for different machines. Everything
// lives in an unnamed namespace and uses nothing from the standard library, so that no function compiled for
// the wider machine can end up in the narrower one's place.

namespace prt {
namespace {

template <int Width>
struct VectorOf;
template <>
struct VectorOf<8> {
  using Type = float __attribute__((vector_size(32), aligned(4), may_alias));
  using Index = int __attribute__((vector_size(32)));
};
template <>
struct VectorOf<16> {
  using Type = float __attribute__((vector_size(64), aligned(4), may_alias));
  using Index = int __attribute__((vector_size(64)));
};

template <int Width>
using Vector = typename VectorOf<Width>::Type;

/// Which element of the concatenation of two vectors each element takes.
template <int Width>
using Index = typename VectorOf<Width>::Index;

template <int Width>
struct Interleave {
  Index<Width> first[3], second[3];  // of r and g, then of that and b, for the three result vectors

  Interleave() {
    for (int v = 0; v < 3; ++v)
      for (int i = 0; i < Width; ++i) {
        const int place = v * Width + i, row = place / 3, colour = place % 3;
        first[v][i] = colour == 1 ? Width + row : row;
        second[v][i] = colour == 2 ? Width + row : i;
      }
  }

  /// result[3 * i + c] = colour[c][i] for `rows` <= Width rows, in whole vectors: up to Width - 1 places
  /// beyond are overwritten.
  void store(const Vector<Width> (&colour)[3], int rows, float* result) const {
    for (int v = 0; v * Width < rows * 3; ++v) {
      const Vector<Width> two = __builtin_shuffle(colour[0], colour[1], first[v]);
      *reinterpret_cast<Vector<Width>*>(result + v * Width) = __builtin_shuffle(two, colour[2], second[v]);
    }
  }
};

/// Rows [row, row + Parts * Width) of one matrix times the light, for all three colours.
/// Channels == 3: each colour has a matrix of its own.
template <int Width, int Parts, int Channels, class T>
inline void multiplyRows(const T* matrix, std::size_t n, std::size_t row, const float* light,
                         const Interleave<Width>& interleave, float* result) {
  constexpr int kPrefetch = 2048;  // bytes ahead
  Vector<Width> sum[Parts][3] = {};
  for (int channel = 0; channel < Channels; ++channel) {
    const T* column = matrix + std::size_t(channel) * n * n + row;
    for (std::size_t j = 0; j < n; ++j, column += n) {
      __builtin_prefetch(reinterpret_cast<const char*>(column) + kPrefetch);
      for (int p = 0; p < Parts; ++p) {
        const Vector<Width> x = load<Width>(column + p * Width);
        if constexpr (Channels == 3) {
          sum[p][channel] += x * light[j * 3 + std::size_t(channel)];
        } else {
          for (int c = 0; c < 3; ++c) sum[p][c] += x * light[j * 3 + std::size_t(c)];
        }
      }
    }
  }
  for (int p = 0; p < Parts; ++p) {
    const std::size_t at = row + std::size_t(p * Width);
    if (at >= n) break;
    interleave.store(sum[p], int(n - at < std::size_t(Width) ? n - at : std::size_t(Width)), result + at * 3);
  }
}

/// 32 rows at a time, then what is left of them. `result` may be overwritten up to Width - 1 places beyond.
template <int Width, int Channels, class T>
inline void multiplyOne(const T* matrix, const MatrixProduct& product, const Interleave<Width>& interleave,
                        float* result) {
  constexpr int kParts = 32 / Width;
  const std::size_t n = product.n;
  std::size_t row = 0;
  for (; n - row > 16; row = row + 32 < n ? row + 32 : n)
    multiplyRows<Width, kParts, Channels>(matrix, n, row, product.light, interleave, result);
  for (; row < n; row += Width)
    multiplyRows<Width, 1, Channels>(matrix, n, row, product.light, interleave, result);
}

/// What one sample overwrites beyond its place the next ones fill; those too near the end have a place apart.
template <int Width, int Channels, class T>
inline void multiplyAll(const T* matrices, const MatrixProduct& product) {
  const Interleave<Width> interleave;
  const std::size_t size = product.channels * product.n * product.n, width = product.n * 3,
                    end = product.samples * width;
  float apart[kKernelMaxFunctions * 3 + Width];
  for (std::size_t s = 0; s < product.samples; ++s) {
    float* result = product.result + s * width;
    const bool room = (s + 1) * width + Width <= end;
    multiplyOne<Width, Channels>(matrices + s * size, product, interleave, room ? result : apart);
    if (!room) __builtin_memcpy(result, apart, width * sizeof(float));
  }
}

template <int Width, class T>
inline void multiplyForChannels(const T* matrices, const MatrixProduct& product) {
  if (product.channels == 3) return multiplyAll<Width, 3>(matrices, product);
  multiplyAll<Width, 1>(matrices, product);
}

}  // namespace
}  // namespace prt
