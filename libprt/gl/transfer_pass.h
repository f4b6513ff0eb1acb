#pragma once
// M_p L at every frame of a patched surface in a compute shader: the matrices stay on the graphics card,
// turned into the frames, and only the light is sent each time. Every function needs the context that was
// current when it was made.

#include "libprt/basis/sh.h"
#include "libprt/gl/objects.h"
#include "libprt/gl/program.h"
#include "libprt/shade/turned_transfer.h"

namespace prt::gl {

class TransferPass {
 public:
  /// Compiles its shader. Throws ResourceError when the driver refuses.
  TransferPass();

  /// What matrices may take: what the driver lets shaders see in one piece, and half a gigabyte at most.
  static std::size_t mostBytes();

  /// Sends them.
  void upload(const TurnedTransfer& turned);
  bool empty() const { return count_ == 0; }
  void forget() { count_ = 0; }
  /// Writes records as BiscaleLight has them, [frames][3][padded] floats; `to` has room for them.
  void apply(const ShRgb& light, const BufferTexture& to);

 private:
  Program program_;
  Buffer matrices_;
  int functions_ = 0, groups_ = 0, count_ = 0;
};

}  // namespace prt::gl
