#include "libprt/meso/rtt_storage.h"

#include "libprt/core/error.h"
#include "libprt/core/half.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

std::vector<std::int64_t> shapeOf(const Rtt& rtt) {
  std::vector<std::int64_t> shape{rtt.texels, rtt.texels, rtt.views, rtt.views, rtt.functions()};
  if (rtt.channels == 3) shape.push_back(3);
  return shape;
}

double relative(std::span<const float> exact, std::span<const float> rounded) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double d = double(exact[i]) - double(rounded[i]);
    difference += d * d, size += double(exact[i]) * double(exact[i]);
  }
  return size > 0 ? std::sqrt(difference / size) : 0;
}

StoredRtt asBytes(const Rtt& rtt) {
  const std::size_t block = rtt.blockSize();
  std::vector<float> low(block, 1e30f), high(block, -1e30f), step(block);
  for (std::size_t i = 0; i < rtt.values.size(); ++i) {
    low[i % block] = std::min(low[i % block], rtt.values[i]);
    high[i % block] = std::max(high[i % block], rtt.values[i]);
  }
  for (std::size_t k = 0; k < block; ++k) step[k] = (high[k] - low[k]) / 255;
  std::vector<std::uint8_t> bytes(rtt.values.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t k = i % block;
    bytes[i] =
        step[k] > 0 ? std::uint8_t(std::clamp((rtt.values[i] - low[k]) / step[k] + 0.5f, 0.0f, 255.0f)) : 0;
  }
  const auto n = std::int64_t(block);
  return {Array::from<std::uint8_t>(std::span<const std::uint8_t>(bytes), shapeOf(rtt)),
          Array::from<float>(std::span<const float>(low), {n}),
          Array::from<float>(std::span<const float>(step), {n}), 0};
}

}  // namespace

StoredRtt storeRtt(const Rtt& rtt, DType type) {
  StoredRtt stored;
  if (type == DType::f32) {
    stored.values = Array::from<float>(std::span<const float>(rtt.values), shapeOf(rtt));
    return stored;
  }
  if (type == DType::f16) {
    std::vector<std::uint16_t> half(rtt.values.size());
    toHalf(rtt.values, half);
    stored.values = {DType::f16, shapeOf(rtt), std::vector<std::byte>(half.size() * 2)};
    std::memcpy(stored.values.bytes.data(), half.data(), stored.values.bytes.size());
  } else if (type == DType::u8) {
    stored = asBytes(rtt);
  } else {
    throw ValueError("cannot store a radiance transfer texture as " + toString(type), "rtt.storage",
                     "use float, half or byte");
  }
  Rtt back = rtt;
  restoreRtt(stored, back);
  stored.error = relative(rtt.values, back.values);
  return stored;
}

void restoreRtt(const StoredRtt& stored, Rtt& rtt) {
  const auto unfit = [] {
    throw FileError("the arrays of a radiance transfer texture do not fit", "project", "bake again");
  };
  const Array& a = stored.values;
  if (a.shape != shapeOf(rtt) || a.bytes.size() != a.size() * sizeOf(a.dtype)) unfit();
  rtt.values.resize(a.size());
  if (a.dtype == DType::f32) {
    std::ranges::copy(a.as<float>(), rtt.values.begin());
  } else if (a.dtype == DType::f16) {
    fromHalf(a.as<std::uint16_t>(), rtt.values);
  } else if (a.dtype == DType::u8) {
    const std::size_t block = rtt.blockSize();
    if (stored.lowest.dtype != DType::f32 || stored.step.dtype != DType::f32 ||
        stored.lowest.bytes.size() != 4 * block || stored.step.bytes.size() != 4 * block)
      unfit();
    const auto low = stored.lowest.as<float>(), step = stored.step.as<float>();
    const auto bytes = a.as<std::uint8_t>();
    for (std::size_t i = 0; i < bytes.size(); ++i)
      rtt.values[i] = low[i % block] + step[i % block] * float(bytes[i]);
  } else {
    unfit();
  }
}

}  // namespace prt
