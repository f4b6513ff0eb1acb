#include "libprt/project/product.h"

#include "libprt/core/error.h"

namespace prt {

std::size_t ProductData::bytes() const {
  std::size_t sum = meta.size();
  for (const auto& [name, array] : arrays) sum += array.bytes.size();
  return sum;
}

const Array& ProductData::array(const std::string& name, DType dtype, std::size_t rank) const {
  const auto found = arrays.find(name);
  if (found == arrays.end()) throw FileError("holds no array '" + name + "'", "project", "bake again");
  if (found->second.dtype != dtype || found->second.shape.size() != rank)
    throw FileError("array '" + name + "' has another type or shape than it must", "project", "bake again");
  return found->second;
}

}  // namespace prt
