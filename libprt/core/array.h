#pragma once
// An n-dimensional array of plain numbers with its type and shape: what stages store in the project
// file and what `prt export --npy` writes. C order, little-endian, immutable once shared.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace prt {

enum class DType { f16, f32, f64, u8, u16, u32, i32, i64 };

std::size_t sizeOf(DType type);
std::string toString(DType type);
/// Throws ValueError when the name is not one of toString's.
DType dtypeFromString(const std::string& name);

template <class T>
constexpr DType dtypeOf() {
  if constexpr (std::is_same_v<T, float>) return DType::f32;
  if constexpr (std::is_same_v<T, double>) return DType::f64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return DType::u8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return DType::u16;
  if constexpr (std::is_same_v<T, std::uint32_t>) return DType::u32;
  if constexpr (std::is_same_v<T, std::int32_t>) return DType::i32;
  if constexpr (std::is_same_v<T, std::int64_t>) return DType::i64;
}

struct Array {
  DType dtype = DType::f32;
  std::vector<std::int64_t> shape;
  std::vector<std::byte> bytes;

  std::size_t size() const {
    std::size_t n = 1;
    for (std::int64_t extent : shape) n *= std::size_t(extent);
    return n;
  }
  /// The elements; T must match the dtype (uint16_t also reads f16 bits).
  template <class T>
  std::span<const T> as() const {
    if (dtypeOf<T>() != dtype && !(dtype == DType::f16 && std::is_same_v<T, std::uint16_t>))
      throw std::logic_error("array of " + toString(dtype) + " read as another type");
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
  template <class T>
  static Array from(std::span<const T> values, std::vector<std::int64_t> shape) {
    Array array{dtypeOf<T>(), std::move(shape), std::vector<std::byte>(values.size_bytes())};
    if (!values.empty()) std::memcpy(array.bytes.data(), values.data(), values.size_bytes());
    return array;
  }
};

}  // namespace prt
