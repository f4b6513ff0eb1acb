#include "libprt/gl/transfer_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace prt::gl {

namespace {
constexpr unsigned kMatrixBinding = 0, kLightBinding = 1;
constexpr int kInGroup = 64,
              kMostGroups = 65535;  // invocations; groups along an axis that every driver takes
}  // namespace

TransferPass::TransferPass() : program_(Program::compute("transfer.comp")), matrices_(Buffer::create()) {}

std::size_t TransferPass::mostBytes() {
  constexpr std::size_t kMost = std::size_t(512) << 20;
  GLint block = 0;
  glGetIntegerv(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
  return std::min(kMost, std::size_t(std::max(block, 0)));
}

void TransferPass::upload(const TurnedTransfer& turned) {
  matrices_.upload(std::span<const std::uint16_t>(turned.halfs));
  functions_ = int(turned.lights), groups_ = int(turned.padded / 8),
  count_ = int(turned.frames) * 3 * groups_;
  program_.set("functions", functions_);
  program_.set("groups", groups_);
  program_.set("channels", turned.channels);
  program_.set("count", count_);
  checkErrors("upload of transfer");
}

void TransferPass::apply(const ShRgb& light, const BufferTexture& to) {
  std::array<Vec3, 100> source{};
  std::copy_n(light.c.begin(), std::min(light.c.size(), std::size_t(functions_)), source.begin());
  program_.set("source", std::span<const Vec3>(source).first(std::size_t(functions_)));
  matrices_.bindStorage(kMatrixBinding);
  to.bindStorage(kLightBinding);
  program_.use();
  const int groups = (count_ + kInGroup - 1) / kInGroup, columns = std::min(groups, kMostGroups);
  glDispatchCompute(unsigned(columns), unsigned((groups + columns - 1) / columns), 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  checkErrors("light on the patch");
}

}  // namespace prt::gl
