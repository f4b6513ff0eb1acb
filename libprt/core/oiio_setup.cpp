#include "libprt/core/oiio_setup.h"

#include <OpenImageIO/imageio.h>

#include <mutex>

namespace prt {

void setUpOiio() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("limits:channels", 1024);
    OIIO::attribute("limits:imagesize_MB", 16384);
  });
}

}  // namespace prt
