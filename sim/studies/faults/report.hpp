#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/faults/study.hpp"

namespace drycut::sim::studies {

/// What the study leaves beside faults.csv; scenarios that repeat cells lie in cells/.
inline const std::vector<std::string> fault_pages = {"report.html", "plots/", "cells/", "junit.xml",
                                                     record::verdict_file};

/// Writes report.html with the matrix, junit.xml with a case a fault, and for each fault with red cells the
/// scenario of the first. Returns what came of it: it fails by a red or damage cell that nobody accepts.
/// Throws std::runtime_error if something cannot be written.
record::Verdict write_faults_report(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                                    const FaultMatrix& matrix, const std::vector<Finding>& findings,
                                    OutputFolder& folder);

/// A line a fault that fails: "knife.encoder.stuck: wrong product, nobody told, at 0..99 %: no more cuts".
std::vector<std::string> failing_lines(const FaultQuestion& question, const FaultMatrix& matrix);

}  // namespace drycut::sim::studies
