#pragma once
#include <optional>
#include <vector>

#include "devices/lx3vp/ecamtbx.hpp"

namespace drycut::devices::lx3vp {

/// Where a table ends, to the pulse.
struct TableEnd {
  std::int32_t master = 0;  ///< above 0
  std::int32_t slave = 0;
};

/// The rows of a profile: every boundary of its pieces, and the rest of `resolution` inside the curved ones,
/// evenly. The master is rounded first and the slave taken there. Rows that round to the same master are one.
/// Nullopt if a curved piece would be left without a row inside, or the master's end is not above 0.
std::optional<std::vector<CamTableRow>> sample_rows(const CamProfile& profile, const TableEnd& end,
                                                    int resolution);

}  // namespace drycut::devices::lx3vp
