#include "tests/fuzz/memory_limit.h"

#include <malloc.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> held{0}, base{0}, peak{0};
std::atomic<std::size_t> limit{~std::size_t{0}};

void* allocate(std::size_t size, std::size_t alignment) {
  if (size > limit) {
    std::fprintf(stderr, "one allocation of %zu bytes, more than the input can justify\n", size);
    std::abort();
  }
  void* block = alignment > alignof(std::max_align_t)
                    ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                    : std::malloc(size ? size : 1);
  if (!block) throw std::bad_alloc();
  const std::size_t now = held += malloc_usable_size(block), start = base;
  const std::size_t above = now > start ? now - start : 0;
  if (above > peak) peak = above;
  if (above > limit) {
    limit = ~std::size_t{0};
    std::fprintf(stderr, "%zu bytes are held, more than the input can justify\n", above);
    std::abort();
  }
  return block;
}

void release(void* block) noexcept {
  if (!block) return;
  held -= malloc_usable_size(block);
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size, 0);
}
void* operator new[](std::size_t size) {
  return allocate(size, 0);
}
// Without these two the sanitizer's own would be used, which ours could not free.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return allocate(size, 0);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
  return operator new(size, tag);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, std::size_t(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, std::size_t(alignment));
}
void operator delete(void* block) noexcept {
  release(block);
}
void operator delete[](void* block) noexcept {
  release(block);
}
void operator delete(void* block, std::size_t) noexcept {
  release(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  release(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  release(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
  release(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  release(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  release(block);
}

namespace prt::fuzz {

void limitMemory(std::size_t bytes) {
  base = held.load();
  peak = 0;
  limit = bytes;
}

std::size_t peakMemory() {
  return peak;
}

}  // namespace prt::fuzz
