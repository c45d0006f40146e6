#pragma once

namespace drycut::bench {

/// Writes trace.h5 with a million rows of 30 channels and tells the processor's seconds for it, without what
/// makes the numbers [s].
double write_hdf5();

}  // namespace drycut::bench
