#include "libprt/core/array.h"

#include "libprt/core/error.h"

#include <array>
#include <utility>

namespace prt {
namespace {

struct TypeInfo {
  DType type;
  const char* name;
  std::size_t bytes;
};

constexpr std::array<TypeInfo, 8> kTypes{{{DType::f16, "f16", 2},
                                          {DType::f32, "f32", 4},
                                          {DType::f64, "f64", 8},
                                          {DType::u8, "u8", 1},
                                          {DType::u16, "u16", 2},
                                          {DType::u32, "u32", 4},
                                          {DType::i32, "i32", 4},
                                          {DType::i64, "i64", 8}}};

}  // namespace

std::size_t sizeOf(DType type) {
  return kTypes[std::size_t(type)].bytes;
}
std::string toString(DType type) {
  return kTypes[std::size_t(type)].name;
}

DType dtypeFromString(const std::string& name) {
  for (const TypeInfo& info : kTypes)
    if (name == info.name) return info.type;
  throw ValueError("unknown element type '" + name + "'", "array",
                   "use f16, f32, f64, u8, u16, u32, i32 or i64");
}

}  // namespace prt
