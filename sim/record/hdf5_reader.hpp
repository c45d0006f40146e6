#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "base/problem.hpp"
#include "base/severity.hpp"
#include "sim/record/record.hpp"

namespace drycut::sim::record {

/// The file is HDF5, by its first bytes.
bool is_hdf5(const std::filesystem::path& file);

/// Whether its attribute written_by names drycut; false of what HDF5 cannot open.
bool names_drycut(const std::filesystem::path& file);

/// How bad an event of a name is, which files do not say.
using SeverityOf = std::function<Severity(const std::string& event)>;

/// Reads trace.h5, also while it is written or after its run was killed: all rows that are whole in it. What
/// is wrong goes to `problems`, and then the result is not to be used.
Record read_hdf5(const std::filesystem::path& file, Problems& problems, const SeverityOf& severity_of = {});

}  // namespace drycut::sim::record
