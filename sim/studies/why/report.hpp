#pragma once
#include <string>
#include <vector>

#include "base/table.hpp"
#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/why/study.hpp"

namespace drycut::sim::studies {

/// Three sentences: when it could be seen coming, why, and until when it could be saved.
std::vector<std::string> why_sentences(const WhyFound& found);
/// The chain before the failure, a row a sign.
Table chain_table(const WhyFound& found);
/// The differences, those of the cause first.
Table difference_table(const WhyFound& found);

inline constexpr auto* why_file = "why.json";
/// What it may write into its folder.
inline const std::vector<std::string> why_files = {why_file, "report.html", "plots/", record::verdict_file};

/// Writes why.json, verdict.json and, with `pictures`, plots/ and report.html. Returns the exit status.
/// Throws std::runtime_error if something cannot be written.
int write_why(const WhyFound& found, OutputFolder& folder, bool pictures);

}  // namespace drycut::sim::studies
