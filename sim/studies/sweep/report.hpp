#pragma once
#include <string>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/record/verdict.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

/// What a study's page and pictures are called in its folder.
inline const std::vector<std::string> study_pages = {"report.html", "plots/", record::verdict_file};

/// Writes report.html and plots/: over two axes a map of what gives way first with lines of equal accuracy
/// and torque, over one axis a curve of every figure, over more axes and of a sample a table; what each point
/// was and the command that repeats it with pictures. Returns what came of it. Throws std::runtime_error if
/// something cannot be written.
record::Verdict write_sweep_report(const PointQuestion& question, const SweepAxes& axes,
                                   const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows,
                                   OutputFolder& folder);

/// The same of the largest values found. Over one axis: the curves of scenes that share it over each other,
/// then each with all that was looked at and what gives way behind its bound; over two axes a map a scene.
/// `envelopes` is one at least.
record::Verdict write_envelope_report(const std::vector<Envelope>& envelopes, OutputFolder& folder);

/// What ends a study in its folder: its verdict, which fails by points that were lost, and the files in their
/// places. Returns the exit status. Throws likewise.
int finish(record::Verdict verdict, const PointStore& store, OutputFolder& folder);

}  // namespace drycut::sim::studies
