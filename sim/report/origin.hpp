#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "renders/report.hpp"

namespace drycut::sim::report {

/// Where a run's scenario comes from, as facts of its report: a date, and the commit of the repository that
/// it lies in. The date is no clock's, so that the same inputs give the same report: SOURCE_DATE_EPOCH, in
/// seconds since 1970 UTC, where the environment has it, for instance the date of the run; else that of the
/// commit; else, where the scenario is in no repository or something there was changed since, that of the
/// scenario's file. Without git, or outside a repository, no commit is told.
std::vector<renders::ReportRow> origin_of(const std::filesystem::path& scenario);

}  // namespace drycut::sim::report
