#include "libprt/core/hash.h"

#include "libprt/core/error.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

namespace prt {
namespace {

struct FreeState {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};
using StatePointer = std::unique_ptr<XXH3_state_t, FreeState>;

StatePointer newState() {
  StatePointer state(XXH3_createState());
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  return state;
}

Hash128 fromXxHash(XXH128_hash_t hash) {
  return {hash.high64, hash.low64};
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string Hash128::hex() const {
  std::array<char, 33> text;
  std::snprintf(text.data(), text.size(), "%016llx%016llx", static_cast<unsigned long long>(high),
                static_cast<unsigned long long>(low));
  return text.data();
}

std::optional<Hash128> Hash128::fromHex(std::string_view text) {
  if (text.size() != 32) return {};
  std::array<std::uint64_t, 2> halves{};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    int digit = 0;
    if (c >= '0' && c <= '9')
      digit = c - '0';
    else if (c >= 'a' && c <= 'f')
      digit = c - 'a' + 10;
    else
      return {};
    halves[i / 16] = halves[i / 16] << 4 | std::uint64_t(digit);
  }
  return Hash128{halves[0], halves[1]};
}

Hash128 hashBytes(std::span<const std::byte> bytes) {
  return fromXxHash(XXH3_128bits(bytes.data(), bytes.size()));
}

Hash128 hashFile(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& what) {
    throw FileError(what, path.string(), "check the path and its permissions");
  };
  if (std::filesystem::is_directory(path)) fail("is a folder, not a file");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(std::string("cannot open it: ") + std::strerror(errno));
  const StatePointer state = newState();
  std::vector<char> buffer(1 << 18);
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), file.get()))
    XXH3_128bits_update(state.get(), buffer.data(), got);
  if (std::ferror(file.get())) fail(std::string("cannot read it: ") + std::strerror(errno));
  return fromXxHash(XXH3_128bits_digest(state.get()));
}

struct Hasher::State {
  StatePointer xxhash = newState();
};

Hasher::Hasher() : state_(std::make_unique<State>()) {}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

Hasher& Hasher::add(std::string_view text) {
  return addFramed('t', 1, 0, text.size(), text.data());
}
Hasher& Hasher::addBytes(std::span<const std::byte> bytes) {
  return addFramed('y', 1, 0, bytes.size(), bytes.data());
}

Hasher& Hasher::add(const Hash128& hash) {
  const std::array<std::uint64_t, 2> halves{hash.high, hash.low};
  return addFramed('h', sizeof halves, 0, 1, halves.data());
}

Hasher& Hasher::addFramed(char kind, std::uint8_t elementSize, std::uint8_t components, std::uint64_t count,
                          const void* data) {
  std::array<char, 11> head{kind, char(elementSize), char(components)};
  std::memcpy(head.data() + 3, &count, sizeof count);
  XXH3_128bits_update(state_->xxhash.get(), head.data(), head.size());
  const std::size_t bytes = std::size_t(elementSize) * std::max<std::size_t>(1, components) * count;
  if (bytes > 0) XXH3_128bits_update(state_->xxhash.get(), data, bytes);
  return *this;
}

Hash128 Hasher::result() const {
  return fromXxHash(XXH3_128bits_digest(state_->xxhash.get()));
}

}  // namespace prt
