#pragma once
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/size/words.hpp"

namespace drycut::sim::studies {

/// Writes report.html and plots/: the ranked table, operating points over the curves of the best motors and,
/// over several gears, reserve and torque of each. Returns what came of it. Throws std::runtime_error if
/// something cannot be written.
record::Verdict write_size_report(const SizeResult& result, OutputFolder& folder);

/// The command that runs a candidate at a corner with pictures.
std::string command_for(const PointQuestion& question, const Candidate& candidate, const Corner& corner);

}  // namespace drycut::sim::studies
