#include "sim/studies/tune/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "renders/report.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/tune/patch.hpp"
#include "sim/studies/tune/plots.hpp"

namespace drycut::sim::studies {

namespace {

using renders::ReportTable;

std::string metric_text(const Verdict& verdict) {
  return std::isfinite(verdict.metric) ? fmt::format("{:.6g}", verdict.metric) : "none";
}

std::string room_text(double room) {
  if (!std::isfinite(room)) return "not measured";
  return room >= 0 ? fmt::format("{:.4g} left", room) : fmt::format("{:.4g} too far", -room);
}

/// For a cell: short. reason_text() has the sentence.
std::string limits_text(const Verdict& verdict) {
  if (verdict.feasible()) return "kept";
  if (verdict.stopped) return "stopped";
  if (verdict.unmeasured()) return "not measured";
  return verdict.note.empty() ? "not kept" : verdict.note;
}

/// Why there is no number, "" if there is one.
std::string reason_text(const Verdict& verdict) {
  return verdict.stopped || verdict.unmeasured() ? limits_text(verdict) + ": " + verdict.note : "";
}

std::string miss_of(const Verdict& verdict) {
  const auto reason = reason_text(verdict);
  return reason.empty() ? limits_text(verdict) : reason;
}

ReportTable before_after(const Tuning& tuning) {
  const auto& after = tuning.trials.at(tuning.best).verdict;
  ReportTable table{"Before and after", {"", "before", "after"}, {}};
  table.rows.push_back({{tuning.study.minimise, metric_text(tuning.before), metric_text(after)}});
  for (std::size_t i = 0; i < tuning.study.constraints.size(); ++i)
    table.rows.push_back(
        {{tuning.study.constraints[i], room_text(tuning.before.room[i]), room_text(after.room[i])}});
  if (!tuning.study.ignore_checks)
    table.rows.push_back({{"failed checks", fmt::format("{}", tuning.before.failed_checks),
                           fmt::format("{}", after.failed_checks)}});
  table.rows.push_back({{"limits", limits_text(tuning.before), limits_text(after)}});
  return table;
}

/// The sentences for what the cells of before_after() call stopped or not measured, each once.
std::string reasons(const Tuning& tuning) {
  const auto before = reason_text(tuning.before);
  const auto after = reason_text(tuning.trials.at(tuning.best).verdict);
  std::string text;
  if (!before.empty()) text += fmt::format("  {}{}\n", before == after ? "" : "before, ", before);
  if (!after.empty() && after != before) text += fmt::format("  after, {}\n", after);
  return text;
}

/// The same for the report's tables of trials, with how many of them it befell.
ReportTable reasons_table(const Tuning& tuning) {
  std::map<std::string, int> told;
  const auto count = [&](const Verdict& verdict) {
    if (const auto reason = reason_text(verdict); !reason.empty()) ++told[reason];
  };
  for (const auto& trial : tuning.trials.trials()) count(trial.verdict);
  if (tuning.spread != nullptr)
    for (const auto& trial : tuning.spread->trials()) count(trial.verdict);
  ReportTable table{"Why there is no number", {"trials", "reason"}, {}};
  for (const auto& [reason, times] : told) table.rows.push_back({{fmt::format("{}", times), reason}});
  return table;
}

ReportTable values(const Tuning& tuning) {
  ReportTable table{"Values", {"parameter", "range", "before", "after"}, {}};
  const auto& parameters = tuning.trials.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    const auto shown = [&](double value) {
      return fmt::format("{:.6g}{}{}", value, p.unit.empty() ? "" : " ", p.unit);
    };
    table.rows.push_back({{p.path, fmt::format("{}..{}", p.low, value_text(p, p.high)),
                           tuning.present[i] ? shown(*tuning.present[i]) : "as the program sets it",
                           shown(tuning.trials.at(tuning.best).point[i])}});
  }
  return table;
}

/// A row a parameter: the cost at each share of the range, and the most it rises: the parameter that matters.
ReportTable around(const Tuning& tuning) {
  ReportTable table{"Around the optimum: " + tuning.study.minimise + ", one parameter at a time",
                    {"parameter", "least", "most", "worst change"},
                    {}};
  const double least_metric = tuning.trials.at(tuning.best).verdict.metric;
  const auto& parameters = tuning.trials.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    double least = least_metric;
    double most = least_metric;
    int beyond = 0;
    for (const auto& slice : tuning.slices) {
      const auto& verdict = tuning.trials.at(slice.trial).verdict;
      if (slice.parameter != i) continue;
      if (!verdict.feasible()) ++beyond;
      if (verdict.stopped) continue;
      least = std::min(least, verdict.metric);
      most = std::max(most, verdict.metric);
    }
    auto change = least_metric != 0
                      ? fmt::format("{:+.1f} %", (most - least_metric) / std::abs(least_metric) * 100)
                      : fmt::format("{:+.4g}", most - least_metric);
    if (beyond > 0) change += fmt::format("; {} beyond a limit", beyond);
    table.rows.push_back(
        {{short_name(parameters[i]), fmt::format("{:.6g}", least), fmt::format("{:.6g}", most), change}});
  }
  return table;
}

ReportTable spread_table(const Tuning& tuning) {
  const auto& trials = tuning.spread->trials();
  ReportTable table{"Spread of the machine, worst first", {}, {}};
  for (const auto& p : tuning.spread->parameters())
    table.headings.push_back(p.unit.empty() ? p.path : fmt::format("{} [{}]", p.path, p.unit));
  table.headings.push_back(tuning.study.minimise);
  table.headings.emplace_back("limits");
  std::vector<std::size_t> order(trials.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return trials[a].verdict.rank() > trials[b].verdict.rank();
  });
  for (const auto index : order) {
    renders::ReportRow row;
    for (const double value : trials[index].point) row.cells.push_back(fmt::format("{:.6g}", value));
    row.cells.push_back(metric_text(trials[index].verdict));
    row.cells.push_back(limits_text(trials[index].verdict));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable trials_table(const Tuning& tuning) {
  ReportTable table{"All trials", {"trial", "phase"}, {}, true};
  for (const auto& p : tuning.trials.parameters()) table.headings.push_back(short_name(p));
  table.headings.push_back(tuning.study.minimise);
  table.headings.emplace_back("limits");
  std::size_t number = 0;
  for (const auto& trial : tuning.trials.trials()) {
    renders::ReportRow row{{fmt::format("{}", ++number), trial.phase}};
    for (const double value : trial.point) row.cells.push_back(fmt::format("{:.6g}", value));
    row.cells.push_back(metric_text(trial.verdict));
    row.cells.push_back(limits_text(trial.verdict));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string as_text(const ReportTable& table) { return table.title + "\n" + renders::rows_text(table, 0); }

/// The least room of a constraint over the spread; NaN if it was never measured.
double least_room(const Trials& spread, std::size_t constraint) {
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const auto& trial : spread.trials()) {
    const double room = trial.verdict.room[constraint];
    if (!(room >= least)) least = std::isnan(room) ? least : room;
  }
  return least;
}

/// The largest metric over the spread; NaN if none was measured.
double largest_metric(const Trials& spread) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const auto& trial : spread.trials()) largest = std::fmax(largest, trial.verdict.metric);
  return largest;
}

}  // namespace

std::string miss_text(const Tuning& tuning) {
  const auto& best = tuning.trials.at(tuning.best).verdict;
  if (best.feasible()) return "";
  if (best.stopped) return "no values tried could be run to the end: " + best.note;
  return "no values tried keep all limits; the best miss is " + miss_of(best);
}

std::size_t worst_of(const Trials& spread) {
  std::size_t worst = 0;
  for (std::size_t i = 1; i < spread.trials().size(); ++i)
    if (spread.at(i).verdict.rank() > spread.at(worst).verdict.rank()) worst = i;
  return worst;
}

std::string summary_text(const Tuning& tuning) {
  std::string text;
  if (auto miss = miss_text(tuning); !miss.empty()) {
    miss.front() = 'N';
    text = miss + "\n\n";
  }
  text += as_text(before_after(tuning)) + reasons(tuning) + "\n" + as_text(values(tuning)) + "\n" +
          as_text(around(tuning));
  if (tuning.spread != nullptr && !tuning.spread->trials().empty()) {
    const auto& worst = tuning.spread->at(worst_of(*tuning.spread));
    const auto& all = tuning.spread->trials();
    const auto beyond =
        std::count_if(all.begin(), all.end(), [](const auto& trial) { return !trial.verdict.feasible(); });
    text += fmt::format("\nSpread of the machine: {} samples, {} beyond a limit; ", all.size(), beyond);
    if (beyond == 0) {
      text += fmt::format("worst {} = {}\n", tuning.study.minimise, metric_text(worst.verdict));
    } else {
      text += fmt::format("worst of the limits: {} (there {} = {}; the largest of all: {:.6g})\n",
                          miss_of(worst.verdict), tuning.study.minimise, metric_text(worst.verdict),
                          largest_metric(*tuning.spread));
    }
    for (std::size_t i = 0; i < worst.point.size(); ++i)
      text += fmt::format("  at {} = {:.4g}{}{}\n", tuning.spread->parameters()[i].path, worst.point[i],
                          tuning.spread->parameters()[i].unit.empty() ? "" : " ",
                          tuning.spread->parameters()[i].unit);
    for (std::size_t i = 0; i < tuning.study.constraints.size(); ++i)
      text += fmt::format("  least room of {}: {}\n", tuning.study.constraints[i],
                          room_text(least_room(*tuning.spread, i)));
  }
  for (std::size_t i = 0; i < tuning.trials.parameters().size(); ++i) {
    const auto& p = tuning.trials.parameters()[i];
    const double value = tuning.trials.at(tuning.best).point[i];
    if (value == p.low || value == p.high)
      text += fmt::format("\n{} lies at an end of its range: beyond it may be better\n", p.path);
  }
  return text + "\n" + patch_text(tuning);
}

void write_tuning_report(const Tuning& tuning, OutputFolder& folder) {
  const auto& after = tuning.trials.at(tuning.best).verdict;
  renders::Report report;
  report.title = "Tuning: " + tuning.study.minimise;
  for (const auto& entry : tuning.study.cases)
    report.scenario += (report.scenario.empty() ? "" : ", ") + entry.file.filename().string();
  report.passed = after.feasible();
  const auto miss = miss_text(tuning);
  report.verdict =
      fmt::format("{}{} from {} to {}; limits: {}", miss.empty() ? "" : miss + "; ", tuning.study.minimise,
                  metric_text(tuning.before), metric_text(after), limits_text(after));
  report.facts = {{{"trials", fmt::format("{}", tuning.trials.trials().size())}},
                  {{"measured from", fmt::format("{} s", loop::seconds_text(tuning.study.from))}},
                  {{"drycut", DRYCUT_VERSION}}};
  report::add_overrides(tuning.study.set, report);
  for (const auto& run : tuning.runs_after) {
    report::add_checks(run.outcome.checks, report);
    report.scenario_expanded += run.expanded;
  }
  report.summary = {before_after(tuning), values(tuning)};
  report.texts = {{"To paste (also in patch.txt)", patch_text(tuning)}};
  report.tables = {around(tuning)};
  if (tuning.spread != nullptr) report.tables.push_back(spread_table(tuning));
  if (auto why = reasons_table(tuning); !why.rows.empty()) report.tables.push_back(std::move(why));
  report.tables.push_back(trials_table(tuning));
  report::add_plots(tuning_plots(tuning), folder, report);
  report.live.clear();  // pictures only
  renders::write_report(report, folder.add(report::report_file));
}

}  // namespace drycut::sim::studies
