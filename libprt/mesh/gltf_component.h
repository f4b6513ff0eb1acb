#pragma once
// Numbers as glTF's accessors hold them.

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace prt {

/// glTF's component types.
enum class GltfComponent {
  i8 = 5120,
  u8 = 5121,
  i16 = 5122,
  u16 = 5123,
  i32 = 5124,
  u32 = 5125,
  f32 = 5126,
  f64 = 5130
};

/// Bytes of a component; 0 for a number that names none.
inline std::size_t componentSize(int type) {
  switch (GltfComponent(type)) {
    case GltfComponent::i8:
    case GltfComponent::u8:
      return 1;
    case GltfComponent::i16:
    case GltfComponent::u16:
      return 2;
    case GltfComponent::i32:
    case GltfComponent::u32:
    case GltfComponent::f32:
      return 4;
    case GltfComponent::f64:
      return 8;
  }
  return 0;
}

/// The component that starts at a byte; integers that are normalised map to -1..1 or 0..1.
inline double readComponent(const char* bytes, int type, bool normalised) {
  const auto raw = [&]<class T>(T value) {
    std::memcpy(&value, bytes, sizeof value);
    return double(value);
  };
  switch (GltfComponent(type)) {
    case GltfComponent::i8:
      return normalised ? std::max(raw(std::int8_t{}) / 127, -1.0) : raw(std::int8_t{});
    case GltfComponent::u8:
      return raw(std::uint8_t{}) / (normalised ? 255 : 1);
    case GltfComponent::i16:
      return normalised ? std::max(raw(std::int16_t{}) / 32767, -1.0) : raw(std::int16_t{});
    case GltfComponent::u16:
      return raw(std::uint16_t{}) / (normalised ? 65535 : 1);
    case GltfComponent::i32:
      return raw(std::int32_t{});
    case GltfComponent::u32:
      return raw(std::uint32_t{});
    case GltfComponent::f32:
      return raw(float{});
    case GltfComponent::f64:
      return raw(double{});
  }
  return 0;
}

}  // namespace prt
