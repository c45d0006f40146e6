#include "sim/studies/compare/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renders/report.hpp"
#include "sim/file.hpp"
#include "sim/report/report.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/format.hpp"
#include "sim/studies/compare/pieces.hpp"

namespace drycut::sim::studies {

namespace {

using renders::ReportTable;

constexpr auto* csv_file = "comparison.csv";
constexpr std::size_t most_rows = 200;  ///< of events that differ; a page must stay readable

/// Seven digits at most, four of them behind the point where that tells a thousandth.
std::string number_text(double number) {
  if (std::isnan(number)) return "";
  const double shown = std::abs(number) < 0.1 ? number : std::round(number * 1e4) / 1e4;
  return fmt::format("{:.{}g}", record::without_noise(shown), std::abs(number) < 0.1 ? 3 : 7);
}

std::vector<Prose> headings(const Comparison& comparison, std::vector<Prose> first) {
  for (const auto& run : comparison.runs) first.push_back(run.label);
  return first;
}

std::string difference_cell(double first, double second) {
  const double difference = second - first;
  return std::isnan(difference)                   ? ""
         : record::without_noise(difference) == 0 ? "0"
                                                  : fmt::format("{:+.4g}", difference);
}

/// Of two runs also by how much the second has more.
ReportTable figure_table(const Comparison& comparison, const std::string& title,
                         const std::vector<Figure>& figures) {
  ReportTable table{title, headings(comparison, {"", "unit"}), {}};
  const bool two = comparison.runs.size() == 2;
  if (two) table.headings.emplace_back("difference");
  for (const auto& figure : figures) {
    renders::ReportRow row{{figure.name, figure.unit}};
    for (const double number : figure.numbers) row.cells.push_back(number_text(number));
    if (two) row.cells.push_back(difference_cell(figure.numbers[0], figure.numbers[1]));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string run_cell(const ComparedRun& run) {
  const auto failed = std::count_if(run.outcome.checks.begin(), run.outcome.checks.end(),
                                    [](const auto& c) { return !c.passed; });
  const auto what = !run.outcome.failure.empty() ? "stopped: " + run.outcome.failure
                    : failed > 0 ? fmt::format("{} of {} checks failed", failed, run.outcome.checks.size())
                                 : fmt::format("{} checks", run.outcome.checks.size());
  return fmt::format("{} {}", run.outcome.passed() ? "PASS" : "FAIL", what);
}

std::string check_cell(const std::optional<record::CheckResult>& result) {
  if (!result) return "-";
  return fmt::format("{} {}\n{}; {}",
                     result->so_far   ? "held so far"
                     : result->passed ? "PASS"
                                      : "FAIL",
                     report::margin_text(*result), result->expectation, result->detail);
}

ReportTable verdict_table(const Comparison& comparison) {
  ReportTable table{"Verdicts", headings(comparison, {"check"}), {}, false, true};
  table.headings.emplace_back("what changed");
  renders::ReportRow whole{{"the run"}};
  for (const auto& run : comparison.runs) whole.cells.push_back(run_cell(run));
  const auto& first = comparison.runs.front();
  const bool alike = std::all_of(comparison.runs.begin(), comparison.runs.end(), [&](const ComparedRun& run) {
    return run.outcome.passed() == first.outcome.passed();
  });
  whole.cells.emplace_back(alike ? "" : "verdict");
  table.rows.push_back(std::move(whole));
  for (const auto& check : comparison.checks) {
    renders::ReportRow row{{check.name}};
    for (const auto& result : check.results) row.cells.push_back(check_cell(result));
    row.cells.push_back(check.change);
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable parameter_table(const Comparison& comparison) {
  ReportTable table{"Parameters in force that differ", headings(comparison, {"parameter"}), {}};
  table.folded = comparison.parameters.size() > most_rows / 10;
  for (const auto& parameter : comparison.parameters) {
    renders::ReportRow row{{parameter.path}};
    for (const auto& value : parameter.values) row.cells.push_back(value.value_or("-"));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable piece_table(const Comparison& comparison, const PieceRows& pieces) {
  const bool two = comparison.runs.size() == 2;
  std::size_t most = 0;
  for (const auto& run : pieces.runs) most = std::max(most, run.size());
  ReportTable table{
      fmt::format("Lengths of {} by their order behind the start-up [{}]{}", pieces.event, pieces.unit,
                  most > most_rows ? fmt::format(", the first {}", most_rows) : ""),
      headings(comparison, {"piece"}),
      {},
      true};
  if (two) table.headings.emplace_back("difference");
  for (std::size_t k = 0; k < std::min(most, most_rows); ++k) {
    renders::ReportRow row{{fmt::format("{}", k + 1)}};
    for (const auto& run : pieces.runs) row.cells.push_back(k < run.size() ? number_text(run[k]) : "");
    if (two)
      row.cells.push_back(k < std::min(pieces.runs[0].size(), pieces.runs[1].size())
                              ? difference_cell(pieces.runs[0][k], pieces.runs[1][k])
                              : "");
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable channel_table(const Comparison& comparison) {
  ReportTable table{"Channels that runs share; rms and peak of what was recorded behind the start-up",
                    {"channel", "unit"},
                    {},
                    true};
  for (const auto& run : comparison.runs) {
    table.headings.push_back(run.label + ": rms");
    table.headings.push_back(run.label + ": peak");
  }
  table.headings.emplace_back("largest difference");
  table.headings.emplace_back("allowed");
  table.headings.emplace_back("at");
  for (const auto& channel : comparison.channels) {
    renders::ReportRow row{{channel.name, channel.unit}};
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
      row.cells.push_back(number_text(channel.rms[i]));
      row.cells.push_back(number_text(channel.peak[i]));
    }
    row.cells.push_back(number_text(channel.difference));
    row.cells.push_back(number_text(channel.allowed));
    row.cells.push_back(channel.difference == 0
                            ? ""
                            : fmt::format("{:.4f} s, {}", channel.at, comparison.runs[channel.in].label));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable event_table(const Comparison& comparison) {
  const auto& rows = comparison.event_differences;
  ReportTable table{rows.size() > most_rows
                        ? fmt::format("Events that differ, the first {} of {}", most_rows, rows.size())
                        : "Events that differ",
                    headings(comparison, {"event"}),
                    {},
                    true};
  for (std::size_t i = 0; i < std::min(rows.size(), most_rows); ++i) {
    renders::ReportRow row{{rows[i].name}};
    for (const auto& told : rows[i].told) row.cells.push_back(told.value_or("-"));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable unmatched_table(const Comparison& comparison) {
  ReportTable table{"Channels of one run only", {"channel"}, {}, true};
  for (const auto& name : comparison.unmatched) table.rows.push_back({{name}});
  return table;
}

void add_tables(const Comparison& comparison, const ComparisonPage& page, renders::Report& report) {
  const auto add = [&](ReportTable table) {
    if (table.rows.empty()) return;
    (table.folded ? report.tables : report.summary).push_back(std::move(table));
  };
  if (!page.figures.empty())
    add(figure_table(comparison, "Compared; statistics of channels are of what was recorded", page.figures));
  add(verdict_table(comparison));
  add(parameter_table(comparison));
  auto events = figure_table(comparison, "Cuts and other events", comparison.events);
  events.folded = !page.figures.empty();
  add(std::move(events));
  for (const auto& pieces : comparison.pieces) add(piece_table(comparison, pieces));
  add(channel_table(comparison));
  add(event_table(comparison));
  add(unmatched_table(comparison));
}

std::vector<renders::Plot> drawn_plots(const Comparison& comparison, const ComparisonPage& page) {
  auto requests = page.overlays;
  for (auto& usual : usual_overlays(comparison)) requests.push_back(std::move(usual));
  return overlay(comparison.runs, requests);
}

/// What the statistics of its channels are taken of.
std::string rate_text(const ComparedRun& run) {
  const auto& times = run.recording.times();
  if (times.size() < 2) return "";
  return fmt::format(", recorded every {}", scenario::format_time(times[1] - times[0]));
}

record::Verdict verdict_of(const Comparison& comparison, const ComparisonPage& page) {
  record::Verdict verdict;
  verdict.title = page.title;
  if (page.passed)
    verdict.judge(*page.passed);
  else
    verdict.word = same(comparison) ? "SAME" : "DIFFERENT";
  verdict.sentence = page.verdict;
  const auto count = [&](const char* of, const auto& list, const auto& counts) {
    verdict.counts[of] = std::count_if(list.begin(), list.end(), counts);
  };
  verdict.counts["runs"] = std::ssize(comparison.runs);
  verdict.counts["checks"] = std::ssize(page.checks);
  count("failed", page.checks, [](const auto& check) { return !check.passed; });
  count("channels_beyond", comparison.channels, [](const auto& channel) { return !channel.is_kept(); });
  verdict.counts["parameters"] = std::ssize(comparison.parameters);
  verdict.scenarios = page.scenarios;
  return verdict;
}

renders::Report report_of(const Comparison& comparison, const ComparisonPage& page,
                          const record::Verdict& verdict) {
  auto report = report::page_of(verdict);
  report.scenario = page.source;
  for (const auto& run : comparison.runs) {
    const double start = comparison.from.value_or(settled(run));
    report.facts.push_back(
        {{run.label,
          fmt::format("{:g} s simulated{}, drycut {}{}", seconds(run.outcome.end), rate_text(run),
                      run.version, start > 0 ? fmt::format("; start-up until {:g} s", start) : "")}});
  }
  if (comparison.from) report.facts.push_back({{"figures from", fmt::format("{:g} s", *comparison.from)}});
  for (const auto& tolerance : page.tolerances) report.facts.push_back({{"--tolerance", tolerance}});
  report.facts.push_back({{"compared by drycut", DRYCUT_VERSION}});
  report::add_checks(page.checks, report);
  add_tables(comparison, page, report);
  return report;
}

}  // namespace

int write_comparison(const Comparison& comparison, const ComparisonPage& page, OutputFolder& folder,
                     bool pictures) {
  const auto verdict = verdict_of(comparison, page);
  write_file(folder.add(csv_file), comparison_table(comparison, page.figures).csv());
  if (pictures)
    report::write_report(report_of(comparison, page, verdict), drawn_plots(comparison, page), folder);
  record::write_verdict(verdict, folder);
  return verdict.exit;
}

std::string comparison_text(const Comparison& comparison, bool judged) {
  constexpr std::size_t most = 20;
  auto text = difference_text(comparison) + "\n";
  const auto tell_of_each = [&](const std::string& name, const auto& values) {
    text += fmt::format("  {}:", name);
    for (std::size_t i = 0; i < values.size(); ++i)
      text += fmt::format("{} {} {}", i == 0 ? "" : ";", comparison.runs[i].label,
                          values[i].value_or("has none"));
    text += "\n";
  };
  for (const auto& check : comparison.checks) {
    if (check.change.empty()) continue;
    text += fmt::format("  {}: {}", check.name, check.change);
    for (std::size_t i = 0; i < check.results.size(); ++i)
      text += fmt::format("; {} {}", comparison.runs[i].label, result_text(check.results[i]));
    text += "\n";
  }
  std::size_t told = 0;
  for (const auto& channel : comparison.channels)
    if (judged && !channel.is_kept() && ++told <= most)
      text += fmt::format("  {}\n", apart_text(channel, comparison));
  for (std::size_t k = 0; judged && k < std::min<std::size_t>(3, comparison.event_differences.size()); ++k) {
    const auto& event = comparison.event_differences[k];
    tell_of_each(event.name, event.told);
  }
  for (const auto& figure : comparison.figures_beyond)
    text += fmt::format("  {} by {:.4g} {}, {:.4g} allowed\n", figure.name, figure.difference, figure.unit,
                        figure.allowed);
  for (std::size_t k = 0; k < std::min(most, comparison.parameters.size()); ++k) {
    const auto& parameter = comparison.parameters[k];
    tell_of_each(parameter.path, parameter.values);
  }
  if (comparison.parameters.size() > most)
    text += fmt::format("  and {} parameters more, in {}\n", comparison.parameters.size() - most, csv_file);
  return text;
}

}  // namespace drycut::sim::studies
