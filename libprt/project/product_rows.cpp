#include "libprt/project/product_rows.h"

#include "libprt/core/error.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace prt {

void unfit(const std::string& stage) {
  throw FileError("the arrays of stage " + stage + " do not fit together", "project", "bake again");
}

double numberOf(const nlohmann::json& meta, const char* name, const std::string& stage) {
  if (!meta.is_object()) unfit(stage);
  const auto found = meta.find(name);
  if (found == meta.end() || !found->is_number()) unfit(stage);
  const double value = found->get<double>();
  if (!std::isfinite(value)) unfit(stage);
  return value;
}

}  // namespace prt
