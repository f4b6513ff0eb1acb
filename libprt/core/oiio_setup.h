#pragma once
// Private to the image readers and writers.

namespace prt {

/// Settings of OpenImageIO that this library needs, made once: no threads of its own (ours are enough, and
/// it is fast enough), and its own limits far above ImageLimits' defaults but finite.
void setUpOiio();

}  // namespace prt
