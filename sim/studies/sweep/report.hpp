#pragma once
#include <string>
#include <vector>

#include "sim/output_folder.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

/// What a study's page and pictures are called in its folder.
inline const std::vector<std::string> study_pages = {"report.html", "plots/"};

/// Writes report.html and plots/: over two axes a map of what gives way first with lines of equal accuracy
/// and torque, over one axis a curve of every figure, over more axes and of a sample a table; what each point
/// was and the command that repeats it with pictures. Throws std::runtime_error if something cannot be
/// written.
void write_sweep_report(const PointQuestion& question, const SweepAxes& axes,
                        const std::vector<SweepPoint>& points, const std::vector<PointRow>& rows,
                        OutputFolder& folder);

/// The same of the largest values found: over one axis a curve with what gives way beyond it, over two axes a
/// map.
void write_envelope_report(const PointQuestion& question, const SweepAxes& axes,
                           const std::vector<SweepPoint>& points, const BoundRequest& request,
                           const std::vector<Bound>& bounds, OutputFolder& folder);

}  // namespace drycut::sim::studies
