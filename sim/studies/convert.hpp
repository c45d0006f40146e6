#pragma once
#include <filesystem>
#include <string>

#include "base/problem.hpp"
#include "sim/record/record.hpp"

namespace drycut::sim::studies {

enum class RecordFormat { csv, hdf5, mcap };

/// Writes what a run recorded into a file of another format, or of the same; CSV has its events in a second
/// one beside it (record::events_beside). The file is there when it is whole. Throws std::runtime_error when
/// something cannot be written.
void write_record(const record::Record& record, RecordFormat format, const std::filesystem::path& file);

/// What HDF5 has no name for among the channels goes to `problems`, which name `run`.
void check_names(const record::Record& record, const std::filesystem::path& run, Problems& problems);

}  // namespace drycut::sim::studies
