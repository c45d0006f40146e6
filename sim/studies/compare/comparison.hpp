#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "sim/studies/compare/differences.hpp"

namespace drycut::sim::studies {

/// Several runs beside each other.
struct Comparison {
  std::vector<ComparedRun> runs;  ///< two at least
  std::optional<double> from;     ///< [s] figures look from here on; absent: see compare_events
  std::vector<CheckRow> checks;
  std::vector<Figure> events;
  std::vector<PieceRows> pieces;
  std::vector<ChannelRow> channels;
  std::vector<std::string> unmatched;  ///< channels
  std::vector<EventRow> event_differences;
  std::size_t events_looked_at = 0;
  std::vector<ParameterRow> parameters;
  std::vector<FigureFault> figures_beyond;  ///< of `events`, those that have an allowance of their own
};

Comparison compare(std::vector<ComparedRun> runs, std::optional<double> from,
                   const Allowances& allowances = {});

/// True if the runs ended alike, with the same checks, events, channels and figures, as far as is allowed.
/// Versions and parameters do not count.
bool kept(const Comparison& comparison);
/// The same, and no parameter differs.
bool same(const Comparison& comparison);

/// What is kept and what is not, a row each: verdicts, events, channels, figures, and with `parameters`
/// these.
std::vector<record::CheckResult> judgement(const Comparison& comparison, bool parameters);

/// "no difference", or what differs: "1 of 9 checks, 2 parameters, 10 of 12 channels".
std::string difference_text(const Comparison& comparison);

/// "knife.speed by 0.3 m/min at 0.1 s in b, 6e-06 m/min allowed"
std::string apart_text(const ChannelRow& channel, const Comparison& comparison);

/// "passed, 0.053 mm left, at 7.204 s", "FAILED", "-" where a run has no such check.
std::string result_text(const std::optional<record::CheckResult>& result);

/// One row a fact: what, name, unit, a column a run. Numbers with nine digits.
Table comparison_table(const Comparison& comparison, const std::vector<Figure>& figures);

}  // namespace drycut::sim::studies
