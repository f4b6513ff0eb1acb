#pragma once
// What stages keep in arrays and read back, with the doubt that a project file deserves.

#include "libprt/project/product.h"

#include <nlohmann/json_fwd.hpp>

#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// Throws the FileError for a stage whose arrays or numbers do not belong together.
[[noreturn]] void unfit(const std::string& stage);

/// A finite number of a product's description; else unfit().
double numberOf(const nlohmann::json& meta, const char* name, const std::string& stage);

/// Vectors as [count, length], numbers as [count].
template <class V>
Array rowsOf(const std::vector<V>& vectors) {
  using T = typename V::value_type;
  const T* first = vectors.empty() ? nullptr : &vectors[0][0];
  return Array::from<T>(std::span(first, vectors.size() * std::size_t(V::length())),
                        {std::int64_t(vectors.size()), V::length()});
}
template <class T>
Array listOf(const std::vector<T>& values) {
  return Array::from<T>(std::span(values), {std::int64_t(values.size())});
}

/// The reverse. Throws FileError when the array is missing or of another shape.
template <class V>
std::vector<V> readRows(const ProductData& data, const std::string& name, const std::string& stage) {
  const Array& array = data.array(name, dtypeOf<typename V::value_type>(), 2);
  if (array.shape[1] != V::length()) unfit(stage);
  std::vector<V> out(std::size_t(array.shape[0]));
  if (array.bytes.size() != out.size() * sizeof(V)) unfit(stage);
  if (!out.empty()) std::memcpy(out.data(), array.bytes.data(), array.bytes.size());
  return out;
}
template <class T>
std::vector<T> readList(const ProductData& data, const std::string& name) {
  const auto values = data.array(name, dtypeOf<T>(), 1).template as<T>();
  return {values.begin(), values.end()};
}

}  // namespace prt
