#pragma once
#include <filesystem>

#include "base/problem.hpp"
#include "sim/records/record.hpp"

namespace drycut::sim::records {

/// The file is HDF5, by its first bytes.
bool is_hdf5(const std::filesystem::path& file);

/// Whether its attribute written_by names drycut; false of what HDF5 cannot open.
bool names_drycut(const std::filesystem::path& file);

/// Reads trace.h5, also while it is written or after its run was killed: all rows that are whole in it. What
/// is wrong goes to `problems`, and then the result is not to be used.
Record read_hdf5(const std::filesystem::path& file, Problems& problems);

}  // namespace drycut::sim::records
