#pragma once
// Content hashes (XXH3, 128 bits): keys of products, checksums of chunks and files. Not cryptographic.
// The same input gives the same hash on every machine.

#include "libprt/core/math.h"

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace prt {

struct Hash128 {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  auto operator<=>(const Hash128&) const = default;
  /// 32 lower-case hexadecimal digits, the high half first.
  std::string hex() const;
  /// The reverse of hex(); nothing when the text is not 32 hexadecimal digits.
  static std::optional<Hash128> fromHex(std::string_view text);
};

/// Hash of the bytes alone.
Hash128 hashBytes(std::span<const std::byte> bytes);

/// Hash of a file's contents alone, as `xxh128sum` prints it. Throws FileError when it cannot be read.
Hash128 hashFile(const std::filesystem::path& path);

/// Hashes a sequence of values. Every value goes in with its kind, element size and count, so that two
/// different sequences never feed the same bytes: "ab","c" differs from "a","bc", and 1 from 1.0.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  Hasher& add(std::string_view text);
  Hasher& add(const char* text) { return add(std::string_view(text)); }
  Hasher& add(const Hash128& hash);
  Hasher& addBytes(std::span<const std::byte> bytes);

  /// A number, boolean or enumerator.
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> Hasher& add(const T& value) {
    return addFramed(kindOf<T>(), sizeof(T), 0, 1, &value);
  }
  template <glm::length_t N, class T>
  Hasher& add(const glm::vec<N, T>& v) {
    return addFramed(kindOf<T>(), sizeof(T), N, 1, &v);
  }
  /// Numbers in contiguous memory: vector, array, span (not text).
  template <std::ranges::contiguous_range R>
  requires(std::is_arithmetic_v<std::ranges::range_value_t<R>> &&
           !std::convertible_to<R, std::string_view>) Hasher& add(const R& values) {
    using T = std::ranges::range_value_t<R>;
    return addFramed(arrayOf(kindOf<T>()), sizeof(T), 0, std::ranges::size(values),
                     std::ranges::data(values));
  }
  /// Points, directions, colours in contiguous memory.
  template <std::ranges::contiguous_range R, class V = std::ranges::range_value_t<R>>
  requires std::same_as<V, glm::vec<V::length(), typename V::value_type>> Hasher& add(const R& vectors) {
    using T = typename V::value_type;
    static_assert(sizeof(V) == V::length() * sizeof(T), "padding would be hashed");
    return addFramed(arrayOf(kindOf<T>()), sizeof(T), V::length(), std::ranges::size(vectors),
                     std::ranges::data(vectors));
  }

  /// Hash of all that was added so far; more may be added after.
  Hash128 result() const;

 private:
  template <class T>
  static constexpr char kindOf() {
    if constexpr (std::is_enum_v<T>)
      return 'e';
    else if constexpr (std::is_floating_point_v<T>)
      return 'f';
    else if constexpr (std::is_same_v<T, bool>)
      return 'b';
    else
      return std::is_signed_v<T> ? 'i' : 'u';
  }
  static constexpr char arrayOf(char kind) { return char(kind - 'a' + 'A'); }
  /// `components` is 0 for plain numbers.
  Hasher& addFramed(char kind, std::uint8_t elementSize, std::uint8_t components, std::uint64_t count,
                    const void* data);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace prt
