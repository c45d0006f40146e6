#include "sim/studies/faults/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/report/report.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/format.hpp"
#include "sim/studies/faults/repeat.hpp"

namespace drycut::sim::studies {

namespace {

using Kind = FaultCell::Kind;
constexpr std::array kinds = {Kind::unharmed, Kind::told,    Kind::wrong,
                              Kind::damage,   Kind::stopped, Kind::lost};

std::string escaped(const std::string& text) { return xml_text(printable(text)); }

std::size_t cell_number(const FaultQuestion& question, std::size_t fault, std::size_t when) {
  return fault * question.when.size() + when;
}

/// Why the first of these cells is what it is.
std::string why_of(const FaultQuestion& question, const FaultMatrix& matrix, std::size_t fault,
                   const FaultStretch& stretch) {
  return text_of(matrix.at(question, fault, stretch.first));
}

void write_faults_junit(const FaultQuestion& question, const FaultMatrix& matrix,
                        const std::filesystem::path& file) {
  std::size_t failures = 0;
  std::size_t errors = 0;
  std::string cases;
  const auto name = question.file.stem().string();
  for (std::size_t fault = 0; fault < question.faults.size(); ++fault) {
    std::string failed;
    std::string broken;
    for (const auto& stretch : stretches_of(question, matrix, fault)) {
      const auto line = fmt::format("{}: {} ({})", stretch.when, std::string(text_of(stretch.kind)),
                                    why_of(question, matrix, fault, stretch));
      const bool red = matrix.fails(cell_number(question, fault, stretch.first));
      const bool error = stretch.kind == Kind::stopped || stretch.kind == Kind::lost;
      if (red) failed += (failed.empty() ? "" : "\n") + line;
      if (error) broken += (broken.empty() ? "" : "\n") + line;
    }
    cases +=
        fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" line=\"1\"", escaped(name),
                    escaped(question.faults[fault].full()), escaped(report::path_from_here(question.file)));
    if (failed.empty() && broken.empty()) {
      cases += "/>\n";
      continue;
    }
    const auto* what = broken.empty() ? "failure" : "error";
    ++(broken.empty() ? failures : errors);
    const auto& text = broken.empty() ? failed : broken;
    cases += fmt::format(">\n      <{0} message=\"{1}\">{2}</{0}>\n    </testcase>\n", what,
                         escaped(text.substr(0, text.find('\n'))), escaped(text));
  }
  write_file(file,
             fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"drycut\">\n"
                         "  <testsuite name=\"faults of {}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}"
                         "  </testsuite>\n</testsuites>\n",
                         escaped(name), question.faults.size(), failures, errors, cases));
}

/// What a cell of the page tells, and behind it what its scenario takes.
std::vector<std::string> texts_of(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                                  const FaultMatrix& matrix, std::size_t fault, std::size_t when) {
  const auto& tried = question.faults[fault];
  const auto& moment = question.when[when];
  const auto number = cell_number(question, fault, when);
  const auto& cell = matrix.cells[number];
  const auto values = CellScenarios::values_of(tried, moment, "");
  return {tried.full() + " = " + tried.quantity(),
          moment.name,
          values.at,
          std::string(text_of(cell.kind)),
          text_of(cell),
          cell.detail,
          std::to_string(cell.cuts),
          matrix.accepted[number] ? entries[*matrix.accepted[number]].why : "",
          values.component,
          values.fault,
          values.quantity,
          values.until,
          CellScenarios::file_name(tried, moment)};
}

/// Some of the moments, all faults.
renders::ReportMatrix matrix_of(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                                const FaultMatrix& matrix, const std::vector<std::size_t>& moments,
                                const CellScenarios& scenarios) {
  using Shade = renders::MatrixRegion::Kind;
  constexpr std::array shades = {Shade::good,   Shade::told, Shade::bad,
                                 Shade::broken, Shade::none, Shade::none};
  renders::ReportMatrix shown;
  shown.down = "fault";
  for (std::size_t i = 0; i < kinds.size(); ++i) shown.regions.push_back({text_of(kinds[i]), shades[i]});
  const auto accepted = shown.regions.size();
  shown.regions.push_back({"accepted", Shade::accepted});
  for (const auto when : moments) shown.columns.push_back(question.when[when].name);
  for (std::size_t fault = 0; fault < question.faults.size(); ++fault) {
    shown.rows.push_back(question.faults[fault].full());
    for (const auto when : moments) {
      const auto number = cell_number(question, fault, when);
      shown.region.push_back(matrix.accepted[number] ? accepted
                                                     : static_cast<std::size_t>(matrix.cells[number].kind));
      shown.cells.push_back(texts_of(question, entries, matrix, fault, when));
    }
  }
  shown.headings = {"fault", "when", "at", "came", "how", "check", "cuts after it", "accepted"};
  shown.file_name = "{12}";
  shown.file = scenarios.text({"{0} at {1}: {3}. {4}", "{8}", "{9}", "{10}", "{2}", "{11}"});
  return shown;
}

std::vector<renders::ReportMatrix> matrices_of(const FaultQuestion& question,
                                               const std::vector<AcceptedCells>& entries,
                                               const FaultMatrix& matrix, const CellScenarios& scenarios) {
  std::vector<std::size_t> spread;
  std::vector<std::size_t> events;
  for (std::size_t when = 0; when < question.when.size(); ++when)
    (question.when[when].name.starts_with("at ") ? events : spread).push_back(when);
  std::vector<renders::ReportMatrix> shown;
  const auto add = [&](const std::vector<std::size_t>& moments, const char* title, const Prose& across) {
    if (moments.empty()) return;
    shown.push_back(matrix_of(question, entries, matrix, moments, scenarios));
    shown.back().title = title;
    shown.back().across = across;
  };
  add(spread, "Every fault at every moment",
      question.cycle > 0
          ? fmt::format("when in the machine cycle of {}, from {} s", scenario::format_time(question.cycle),
                        record::seconds_text(question.begin))
          : "when in the run");
  add(events, "Every fault at each kind of event", "when this happens");
  constexpr auto* caption =
      "Each cell is a run that went on from the kept state of its moment with the fault put in. The file of "
      "a "
      "cell goes into the folder cells of these results, where it finds the line: drycut run runs it.";
  for (auto& one : shown) one.caption = caption;
  return shown;
}

std::string plural(std::size_t count, const char* noun) {
  return counted(static_cast<std::int64_t>(count), noun);
}

renders::ReportTable failing_table(const FaultQuestion& question, const FaultMatrix& matrix) {
  renders::ReportTable table{
      "Red cells that nobody accepts", {"fault", "moments", "when", "came", "the first of them"}, {}};
  for (std::size_t fault = 0; fault < question.faults.size(); ++fault)
    for (const auto& stretch : stretches_of(question, matrix, fault))
      if (matrix.fails(cell_number(question, fault, stretch.first)))
        table.rows.push_back(
            {{question.faults[fault].full(), std::to_string(stretch.count), stretch.when,
              std::string(text_of(stretch.kind)), why_of(question, matrix, fault, stretch)}});
  return table;
}

renders::ReportTable accepted_table(const std::vector<AcceptedCells>& entries, const FaultMatrix& matrix) {
  renders::ReportTable table{"Accepted", {"fault", "when", "cell", "cells", "why"}, {}};
  for (std::size_t i = 0; i < entries.size(); ++i)
    table.rows.push_back(
        {{entries[i].fault, entries[i].when, std::string(record::word_of(entries[i].cell)),
          std::to_string(std::ranges::count(matrix.accepted, std::optional(i))), entries[i].why}});
  return table;
}

record::Verdict verdict_of(const FaultQuestion& question, const FaultMatrix& matrix,
                           const std::vector<Finding>& findings) {
  record::Verdict verdict;
  verdict.title = "Faults of " + question.file.stem().string();
  verdict.scenarios = {question.file.generic_string()};
  const auto count = [&](Kind kind) {
    return static_cast<std::size_t>(std::ranges::count(matrix.cells, kind, &FaultCell::kind));
  };
  std::size_t failing = 0;
  for (std::size_t i = 0; i < matrix.cells.size(); ++i) failing += matrix.fails(i) ? 1 : 0;
  verdict.counts["cells"] = std::ssize(matrix.cells);
  verdict.counts["faults"] = std::ssize(question.faults);
  verdict.counts["moments"] = std::ssize(question.when);
  verdict.counts["failing"] = static_cast<long long>(failing);
  for (const auto kind : kinds)
    verdict.counts[std::string(record::word_of(kind))] = static_cast<long long>(count(kind));
  std::vector<std::string> parts;
  for (const auto kind : kinds)
    if (count(kind) > 0) parts.push_back(fmt::format("{} {}", count(kind), std::string(text_of(kind))));
  verdict.sentence = fmt::format("{} at {}: {}", plural(question.faults.size(), "fault"),
                                 plural(question.when.size(), "moment"), fmt::join(parts, ", "));
  const auto accepted = matrix.accepted.size() - static_cast<std::size_t>(std::ranges::count(
                                                     matrix.accepted, std::optional<std::size_t>()));
  if (accepted > 0) verdict.sentence += fmt::format("; {} of them accepted", accepted);
  verdict.judge(failing == 0);
  verdict.found(question.notes);
  verdict.found(findings);
  if (failing > 0) verdict.found({{"faults.red"_code, ""}});
  if (count(Kind::stopped) + count(Kind::lost) > 0) verdict.stopped();
  return verdict;
}

}  // namespace

std::vector<std::string> failing_lines(const FaultQuestion& question, const FaultMatrix& matrix) {
  std::vector<std::string> lines;
  for (std::size_t fault = 0; fault < question.faults.size(); ++fault)
    for (const auto& stretch : stretches_of(question, matrix, fault))
      if (matrix.fails(cell_number(question, fault, stretch.first)))
        lines.push_back(fmt::format("{}: {} ({}): {}", question.faults[fault].full(),
                                    std::string(text_of(stretch.kind)), stretch.when,
                                    why_of(question, matrix, fault, stretch)));
  return lines;
}

record::Verdict write_faults_report(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                                    const FaultMatrix& matrix, const std::vector<Finding>& findings,
                                    OutputFolder& folder) {
  auto verdict = verdict_of(question, matrix, findings);
  auto page = report::page_of(verdict);
  page.scenario = question.file.filename().string();
  page.facts = {{{"scenario", question.file.string()}}};
  for (const auto& [path, value] : question.set)
    page.facts.push_back({{"set", fmt::format("{} = {}", path, value)}});
  const auto& said = question.scenario->faults;
  page.facts.push_back({{"told in time", scenario::format_time(said.within)}});
  page.facts.push_back(
      {{"told by",
        said.told ? said.told->text : "an error of the controller, or a drive that it switches off"}});
  std::vector<std::string> product;
  for (const auto& check : question.scenario->checks) product.push_back(check.name.text);
  page.facts.push_back({{"good product", fmt::format("{}", fmt::join(product, ", "))}});
  page.facts.push_back({{"drycut", DRYCUT_VERSION}});
  page.notes = record::lines_of(question.notes);
  for (auto& line : record::lines_of(findings)) page.notes.push_back(std::move(line));
  if (auto red = failing_table(question, matrix); !red.rows.empty()) page.summary.push_back(std::move(red));
  if (!entries.empty()) page.tables.push_back(accepted_table(entries, matrix));
  const CellScenarios scenarios(question, folder.path() / "cells");
  page.matrices = matrices_of(question, entries, matrix, scenarios);
  for (std::size_t fault = 0; fault < question.faults.size(); ++fault)
    for (const auto& stretch : stretches_of(question, matrix, fault)) {
      if (!matrix.fails(cell_number(question, fault, stretch.first))) continue;
      const auto& tried = question.faults[fault];
      const auto& moment = question.when[stretch.first];
      auto comment =
          fmt::format("{} at {}: {}. {}", tried.full(), moment.name, std::string(text_of(stretch.kind)),
                      why_of(question, matrix, fault, stretch));
      std::ranges::replace(comment, '\n', ' ');
      write_file(folder.add("cells/" + CellScenarios::file_name(tried, moment)),
                 scenarios.text(CellScenarios::values_of(tried, moment, std::move(comment))));
    }
  write_faults_junit(question, matrix, folder.add("junit.xml"));
  report::write_report(std::move(page), {}, folder);
  return verdict;
}

}  // namespace drycut::sim::studies
