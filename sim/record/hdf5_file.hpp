#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "base/problem.hpp"
#include "sim/record/record.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::record {

/// trace.h5: channels and events of a run in HDF5 (docs/records.md), written while the run goes on. It can be
/// read at any moment by SWMR, and after whatever has ended the run. Rows come into
/// the file by blocks of 4096, events after a second of machine time at the latest. The same inputs give the
/// same bytes. `recording` has all its channels and outlives this. Throws std::runtime_error when something
/// cannot be written, also later.
std::unique_ptr<Observer> hdf5_writer(const Recording& recording, const std::filesystem::path& file,
                                      const About& about);

/// Adds the tables `outcome`, `checks`, `alarms` and `drives` to the file of a run that has come to its end.
/// Throws std::runtime_error if it cannot be written.
void add_outcome(const std::filesystem::path& file, const Outcome& outcome);

/// The file is HDF5, by its first bytes.
bool is_hdf5(const std::filesystem::path& file);

/// Whether its attribute written_by names drycut; false of what HDF5 cannot open.
bool names_drycut(const std::filesystem::path& file);

/// How bad an event of a name is, which files do not say.
using SeverityOf = std::function<Severity(const std::string& event)>;

/// Reads trace.h5, also while it is written or after its run was killed: all rows that are whole in it. What
/// is wrong goes to `problems`, and then the result is not to be used.
Record read_hdf5(const std::filesystem::path& file, Problems& problems, const SeverityOf& severity_of = {});

/// Of HDF5's library: "1.10.8".
std::string hdf5_version();

/// What needs HDF5's library, all of it in sim/record/hdf5/: a library of its own, which is loaded when the
/// first such file is written or read. The functions above by other names.
struct Hdf5Library {
  std::unique_ptr<Observer> (*writer)(const Recording&, const std::filesystem::path&, const About&);
  void (*add_outcome)(const std::filesystem::path&, const Outcome&);
  bool (*names_drycut)(const std::filesystem::path&);
  Record (*read)(const std::filesystem::path&, Problems&, const SeverityOf&);
  std::string (*version)();
};

}  // namespace drycut::sim::record
