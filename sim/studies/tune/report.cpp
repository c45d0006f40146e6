#include "sim/studies/tune/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/text.hpp"
#include "renders/report.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/tune/patch.hpp"
#include "sim/studies/tune/plots.hpp"

namespace drycut::sim::studies {

namespace {

using renders::ReportTable;

std::string with_space(const std::string& unit) { return unit.empty() ? "" : " " + unit; }

std::string metric_text(const Verdict& verdict) {
  return std::isfinite(verdict.metric) ? fmt::format("{:.6g}", verdict.metric) : "none";
}

/// "rms(AxisX.follerr) [Count]".
std::string metric_heading(const Tuning& tuning) {
  const auto& unit = tuning.study.metric_unit;
  return unit.empty() ? tuning.study.minimise : fmt::format("{} [{}]", tuning.study.minimise, unit);
}

/// "rms(AxisX.follerr) = 4.6 Count".
std::string metric_equals(const Tuning& tuning, const std::string& value) {
  return fmt::format("{} = {}{}", tuning.study.minimise, value, with_space(tuning.study.metric_unit));
}

std::string room_text(const Tuning& tuning, std::size_t constraint, double room) {
  if (!std::isfinite(room)) return "not measured";
  return fmt::format("{:.4g}{} {}", std::abs(room), with_space(tuning.study.room_units[constraint]),
                     room >= 0 ? "left" : "too far");
}

/// Why the limits are not kept, "" where they are.
std::string reason_text(const Verdict& verdict) {
  if (verdict.feasible()) return "";
  if (verdict.stopped) return "stopped: " + verdict.note;
  if (verdict.unmeasured()) return "not measured: " + verdict.note;
  return verdict.note.empty() ? "limits are not kept" : verdict.note;
}

/// The same in a word, for a cell whose reason stands elsewhere.
std::string limits_text(const Verdict& verdict) {
  if (verdict.feasible()) return "kept";
  if (verdict.stopped) return "stopped";
  return verdict.unmeasured() ? "not measured" : "not kept";
}

/// For a cell of a table of trials: short where the reason is a sentence.
std::string trial_text(const Verdict& verdict) {
  const bool unknown = std::ranges::any_of(verdict.room, [](double room) { return std::isnan(room); });
  if (verdict.feasible() && unknown) return "kept what was measured; not its margins: no better";
  return verdict.feasible() || verdict.stopped || verdict.unmeasured() ? limits_text(verdict)
                                                                       : reason_text(verdict);
}

ReportTable before_after(const Tuning& tuning) {
  const auto& after = tuning.after();
  ReportTable table{"Before and after", {"", "before", "after"}, {}};
  table.rows.push_back({{metric_heading(tuning), metric_text(tuning.before), metric_text(after)}});
  for (std::size_t i = 0; i < tuning.study.constraints.size(); ++i)
    table.rows.push_back({{tuning.study.constraints[i], room_text(tuning, i, tuning.before.room[i]),
                           room_text(tuning, i, after.room[i])}});
  if (!tuning.study.ignore_checks)
    table.rows.push_back({{"failed checks", fmt::format("{}", tuning.before.failed_checks),
                           fmt::format("{}", after.failed_checks)}});
  table.rows.push_back({{"limits", limits_text(tuning.before), limits_text(after)}});
  return table;
}

/// What the first sentence has not said: why the values before did not keep the limits.
std::string reason_before(const Tuning& tuning) {
  if (tuning.stays || tuning.unmeasurable) return "";
  const auto reason = reason_text(tuning.before);
  return reason.empty() ? "" : fmt::format("  before: {}\n", reason);
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
  ReportTable table{"Why trials do not count", {"trials", "reason"}, {}};
  for (const auto& [reason, times] : told) table.rows.push_back({{fmt::format("{}", times), reason}});
  return table;
}

ReportTable values(const Tuning& tuning) {
  ReportTable table{"Values", {"parameter", "range", "before", "set by", "after"}, {}};
  const auto& parameters = tuning.trials.parameters();
  const auto answer = tuning.answer();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    const auto& present = tuning.present[i];
    table.rows.push_back({{p.own_unit.empty() ? p.path : fmt::format("{} [{}]", p.path, p.own_unit),
                           shown_range(p), present.value ? shown_value(p, *present.value) : "not known",
                           present.set_by, answer ? shown_value(p, (*answer)[i]) : "as before"}});
  }
  return table;
}

std::string hunts_from_text(double from) {
  if (!std::isfinite(from)) return "at no gain that was tried";
  return fmt::format("from {:.3g} times the gain on", from);
}

/// Where there is play: what became of pushes, for the answer and over the spread; "" where there is none.
std::string pushes_text(const Tuning& tuning) {
  const auto& cases = tuning.study.cases;
  const auto played =
      std::find_if(cases.begin(), cases.end(), [](const auto& entry) { return !entry.play.empty(); });
  const double from = tuning.after().hunts_from;
  if (played == cases.end()) return "";
  if (std::isnan(from)) return fmt::format("{}: whether it hunts after a push is not known", played->play);
  auto text =
      fmt::format("{}: pushed at rest by {} to {} V it {}; it hunts {}", played->play, least_push,
                  largest_push, from <= 1 ? "goes on hunting" : "comes to rest again", hunts_from_text(from));
  if (tuning.spread == nullptr) return text;
  double least = std::numeric_limits<double>::infinity();
  int hunting = 0;
  for (const auto& trial : tuning.spread->trials()) {
    least = std::fmin(least, trial.verdict.hunts_from);
    if (trial.verdict.hunts_from <= 1) ++hunting;
  }
  return text + (hunting > 0
                     ? fmt::format("; over the spread {} on hunting, the worst {}",
                                   hunting == 1 ? "1 machine goes" : fmt::format("{} machines go", hunting),
                                   hunts_from_text(least))
                     : fmt::format("; over the spread no machine hunts, the nearest to it would {}",
                                   hunts_from_text(least)));
}

/// What the ranges leave out, a line each.
std::string at_the_ends(const Tuning& tuning) {
  std::string text;
  const auto& parameters = tuning.trials.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = parameters[i];
    const auto& present = tuning.present[i];
    if (!present.in_range(p))
      text += fmt::format("{} is {} now: outside of the range {}\n", p.path, shown_value(p, *present.value),
                          shown_range(p));
    const double found = tuning.trials.at(tuning.best).point[i];
    if (!tuning.stays && (found == p.low || found == p.high))
      text += fmt::format("{} lies at an end of its range: beyond it may be better\n", p.path);
  }
  return text;
}

/// A row a parameter: the cost at each share of the range, and the most it rises: the parameter that matters.
ReportTable around(const Tuning& tuning) {
  ReportTable table{"Around the optimum: " + metric_heading(tuning) + ", one parameter at a time",
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
  for (const auto& p : tuning.spread->parameters()) table.headings.push_back(shown_heading(p));
  table.headings.push_back(metric_heading(tuning));
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
    row.cells.push_back(trial_text(trials[index].verdict));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable trials_table(const Tuning& tuning) {
  ReportTable table{"All trials", {"trial", "phase"}, {}, true};
  for (const auto& p : tuning.trials.parameters()) table.headings.push_back(shown_heading(p));
  table.headings.push_back(metric_heading(tuning));
  table.headings.emplace_back("limits");
  std::size_t number = 0;
  for (const auto& trial : tuning.trials.trials()) {
    renders::ReportRow row{{fmt::format("{}", ++number), trial.phase}};
    for (const double value : trial.point) row.cells.push_back(fmt::format("{:.6g}", value));
    row.cells.push_back(metric_text(trial.verdict));
    row.cells.push_back(trial_text(trial.verdict));
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

bool has_play(const Tuning& tuning) {
  return std::ranges::any_of(tuning.study.cases, [](const auto& entry) { return !entry.play.empty(); });
}

/// With play a margin is one of its sine.
std::string sine_text(const Tuning& tuning) {
  if (!tuning.study.needs_loop || !has_play(tuning)) return "";
  return fmt::format("; phase margins hold for a sine of {:.3g} V only", tuning.study.loop.sine());
}

/// What the budget had no room for.
std::string budget_text(const Tuning& tuning) {
  if (tuning.unmeasurable || tuning.settled) return "";
  return fmt::format(
      "; the search ended with its budget before it came to a bottom: more than --budget {} may find "
      "better",
      tuning.budget);
}

/// "; checks ignored, 1 of 7 failed with these values"; "" where they count.
std::string ignored_text(const Tuning& tuning) {
  if (!tuning.study.ignore_checks) return "";
  std::size_t failed = 0;
  std::size_t all = 0;
  for (const auto& run : tuning.runs_after)
    for (const auto& check : run.outcome.checks) {
      ++all;
      if (!check.passed) ++failed;
    }
  return fmt::format("; checks ignored (--ignore-checks), {} of {} failed with these values", failed, all);
}

}  // namespace

std::string miss_text(const Tuning& tuning) {
  const auto& after = tuning.after();
  if (tuning.unmeasurable) {
    const auto& trials = tuning.trials.trials();
    const auto doubted = std::find_if(trials.begin(), trials.end(),
                                      [](const Trials::Trial& trial) { return trial.verdict.doubtful; });
    return fmt::format("Margins could not be measured, so nothing was searched: {}", doubted->verdict.note);
  }
  std::string text;
  if (after.stopped)
    text = "No values could be run to the end: " + after.note;
  else if (!after.feasible())
    text = "No values met all limits. Closest: " + reason_text(after);
  if (tuning.unlike)
    text += fmt::format(
        "{}Where {} given as the program sets {}, {} is {:.6g}{} and not {}: the program does something else "
        "then, and no trial is a comparison with the values before; tune what it leaves out, too, or let it "
        "set the rest always",
        text.empty() ? "" : ". ", tuning.present.size() == 1 ? "the value is" : "the values are",
        tuning.present.size() == 1 ? "it" : "them", tuning.study.minimise, *tuning.unlike,
        with_space(tuning.study.metric_unit), metric_text(tuning.before));
  if (!tuning.stays) return text;
  return text + fmt::format("{}The present values stay: none of {} that were tried is better",
                            text.empty() ? "" : ". ",
                            counted(tuning.trials.trials().size() - (tuning.start ? 1 : 0), "other"));
}

std::string runs_text(const Tuning& tuning) {
  int sum = 0;
  std::string parts;
  for (const auto& [part, runs] : tuning.used) {
    sum += runs;
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", part, runs);
  }
  const int loops = tuning.trials.loop_runs() + (tuning.spread != nullptr ? tuning.spread->loop_runs() : 0);
  return fmt::format("{} of at most {}: {}{}", sum, tuning.budget, parts,
                     loops > 0 ? fmt::format("; {} of them to measure margins{}", loops,
                                             has_play(tuning) ? " and to push the loop" : "")
                               : "");
}

std::size_t worst_of(const Trials& spread) {
  std::size_t worst = 0;
  for (std::size_t i = 1; i < spread.trials().size(); ++i)
    if (spread.at(i).verdict.rank() > spread.at(worst).verdict.rank()) worst = i;
  return worst;
}

/// How the values do on machines that differ.
std::string spread_text(const Tuning& tuning) {
  if (tuning.spread == nullptr || tuning.spread->trials().empty()) return "";
  const auto& worst = tuning.spread->at(worst_of(*tuning.spread));
  const auto& all = tuning.spread->trials();
  const auto beyond =
      std::count_if(all.begin(), all.end(), [](const auto& trial) { return !trial.verdict.feasible(); });
  std::string text =
      fmt::format("\nSpread of the machine: {}{}, {} beyond a limit; ", counted(all.size(), "sample"),
                  static_cast<int>(all.size()) < tuning.spread_asked
                      ? fmt::format(" of the {} asked for (--budget)", tuning.spread_asked)
                      : "",
                  beyond);
  if (beyond == 0) {
    text += fmt::format("worst {}\n", metric_equals(tuning, metric_text(worst.verdict)));
  } else {
    text += fmt::format("worst of the limits: {} (there {}; the largest of all: {:.6g}{})\n",
                        reason_text(worst.verdict), metric_equals(tuning, metric_text(worst.verdict)),
                        largest_metric(*tuning.spread), with_space(tuning.study.metric_unit));
  }
  const auto at = [&](const Point& point) {
    std::string where;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const auto& p = tuning.spread->parameters()[i];
      where += fmt::format("  at {} = {}, of {}\n", p.path, shown_value(p, point[i]), shown_range(p));
    }
    return where;
  };
  text += at(worst.point);
  if (!tuning.study.constraints.empty()) text += "Of all of them, each of its own machine:\n";
  for (std::size_t i = 0; i < tuning.study.constraints.size(); ++i)
    text += fmt::format("  least room of {}: {}\n", tuning.study.constraints[i],
                        room_text(tuning, i, least_room(*tuning.spread, i)));
  if (tuning.study.needs_loop && has_play(tuning))
    text += fmt::format(
        "  (phase margins are of a sine of {:.3g} V, in which masses and play hardly take part; gain margins "
        "of "
        "pushes of {} to {} V)\n",
        tuning.study.loop.sine(), least_push, largest_push);
  return text;
}

std::string summary_text(const Tuning& tuning) {
  std::string text;
  if (const auto miss = miss_text(tuning); !miss.empty()) text = miss + "\n\n";
  text += as_text(before_after(tuning)) + reason_before(tuning) + "\n" + as_text(values(tuning));
  if (!tuning.slices.empty()) text += "\n" + as_text(around(tuning));
  if (const auto more = budget_text(tuning); !more.empty()) text += fmt::format("\n{}\n", more.substr(2));
  text += spread_text(tuning);
  if (const auto pushes = pushes_text(tuning); !pushes.empty()) text += fmt::format("\n{}\n", pushes);
  if (const auto ends = at_the_ends(tuning); !ends.empty()) text += "\n" + ends;
  return text + "\n" + patch_text(tuning);
}

record::Verdict verdict_of(const Tuning& tuning) {
  const auto& after = tuning.after();
  record::Verdict verdict;
  verdict.title = "Tuning: " + tuning.study.minimise;
  for (const auto& entry : tuning.study.cases) verdict.scenarios.push_back(entry.file.generic_string());
  verdict.judge(after.feasible() && !tuning.unmeasurable && !tuning.unlike);
  if (after.stopped) verdict.stopped();
  auto first = miss_text(tuning);
  if (!first.empty()) first += ". ";
  const auto unit = with_space(tuning.study.metric_unit);
  const auto change = tuning.stays ? metric_equals(tuning, metric_text(after))
                                   : fmt::format("{}: {}{} before, {}{} after", tuning.study.minimise,
                                                 metric_text(tuning.before), unit, metric_text(after), unit);
  verdict.sentence = first + change + (after.feasible() ? "; all limits kept" : "") + sine_text(tuning) +
                     budget_text(tuning) + ignored_text(tuning);
  verdict.counts["tried"] = std::ssize(tuning.trials.trials());
  for (const auto& part : tuning.used) verdict.counts["runs"] += part.second;
  return verdict;
}

void write_tuning_report(const Tuning& tuning, OutputFolder& folder) {
  auto report = report::page_of(verdict_of(tuning));
  for (const auto& entry : tuning.study.cases)
    report.scenario += (report.scenario.empty() ? "" : ", ") + entry.file.filename().string();
  report.facts = {{{"sets of values tried", fmt::format("{}", tuning.trials.trials().size())}},
                  {{"simulated runs", runs_text(tuning)}},
                  {{"measured from", fmt::format("{} s", record::seconds_text(tuning.study.from))}},
                  {{"drycut", DRYCUT_VERSION}}};
  if (const auto pushes = pushes_text(tuning); !pushes.empty()) report.facts.push_back({{"pushes", pushes}});
  if (const auto ends = at_the_ends(tuning); !ends.empty()) report.facts.push_back({{"ranges", ends}});
  report::add_overrides(tuning.study.set, report);
  report.checks_title =
      tuning.stays ? "Checks of the run with the present values" : "Checks of the run with the values found";
  for (const auto& run : tuning.runs_after) {
    report::add_checks(run.outcome.checks, report);
    report.scenario_expanded += run.expanded;
  }
  report.summary = {before_after(tuning), values(tuning)};
  report.texts = {{"To paste (also in patch.txt)", patch_text(tuning)}};
  if (const auto spread = spread_text(tuning); !spread.empty())
    report.texts.push_back({"Machines that differ", spread.substr(1)});
  if (!tuning.slices.empty()) report.tables = {around(tuning)};
  if (tuning.spread != nullptr) report.tables.push_back(spread_table(tuning));
  if (auto why = reasons_table(tuning); !why.rows.empty()) report.tables.push_back(std::move(why));
  report.tables.push_back(trials_table(tuning));
  report::add_plots(tuning_plots(tuning), folder, report);
  report.live.clear();  // pictures only
  renders::write_report(report, folder.add(report::report_file));
}

}  // namespace drycut::sim::studies
