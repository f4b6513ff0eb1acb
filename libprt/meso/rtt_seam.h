#pragma once
// Whether a radiance transfer texture tiles, and making it. Pictures of a real sample end where they were
// cut: opposite borders do not meet, and every repeat shows a line.

#include "libprt/core/job.h"
#include "libprt/meso/rtt.h"

namespace prt {

/// Root-mean-square step across the borders that meet when the texture repeats, against that between
/// neighbouring texels inside, over all views and functions. Near 1 for what tiles; 1 where the borders
/// differ by less than 1e-5 of the values.
double seamStep(const Rtt& rtt);

/// Above this the borders show as lines.
inline constexpr double kVisibleSeam = 1.5;

/// Takes from every image of the table (a view's i-th coefficient over the patch) the smoothest image that
/// has the steps across its borders, so that the steps left are as large as those inside and mean and detail
/// stay (Moisan 2011, "Periodic plus smooth image decomposition": Poisson's equation on the torus, solved by
/// Fourier transform). Linear, so that light and views stay as they are to each other. Throws Cancelled.
void makeSeamless(Rtt& rtt, Job& job);

}  // namespace prt
