#pragma once
#include "sim/record/hdf5_file.hpp"

// What the library shows, function by function (Hdf5Library).
namespace drycut::sim::record {

std::unique_ptr<Observer> write_hdf5(const Recording& recording, const std::filesystem::path& file,
                                     const About& about);
void add_outcome_to(const std::filesystem::path& file, const Outcome& outcome);
bool says_drycut(const std::filesystem::path& file);
Record read_from(const std::filesystem::path& file, Problems& problems, const SeverityOf& severity_of);

}  // namespace drycut::sim::record
