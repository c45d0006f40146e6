#include "sim/studies/sweep/point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <regex>

#include "base/text.hpp"
#include "plants/plant.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/loop/statistics.hpp"
#include "sim/studies/recorded_csv.hpp"
#include "sim/studies/sweep/rated_drive.hpp"
#include "sim/studies/tune/metric.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr auto* figure_option = "--figure";
constexpr std::array<std::string_view, 5> verdicts = {"passed", "failed", "refused", "diverged", "lost"};
constexpr std::array<std::string_view, 5> verdict_notes = {
    "", "", " (input wrong, not simulated)", " (the simulation stopped)", " (whoever ran it died)"};

std::vector<Metric> metrics_of(const PointQuestion& question, Problems& problems) {
  std::vector<Metric> metrics;
  for (const auto& [name, term] : question.figures) {
    std::vector<scenario::ExpressionFault> faults;
    auto metric = Metric::compile(term, Metric::Kind::number, question.events, faults,
                                  [&](const std::string& channel) -> std::optional<std::string> {
                                    for (const auto& [known, unit] : question.units)
                                      if (known == channel) return unit;
                                    return {};
                                  });
    for (auto& fault : faults)
      problems.push_back({fault.code, figure_option, 1, static_cast<int>(name.size() + 1 + fault.offset) + 1,
                          fault.what, fault.remedy});
    if (metric) metrics.push_back(std::move(*metric));
  }
  return metrics;
}

/// Records what the figures look at; a channel that there is none of is told at its place in the figure.
void record_names(const PointQuestion& question, const std::vector<Metric>& metrics,
                  scenario::Scenario& scenario) {
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    for (const auto& name : metrics[i].names()) {
      if (!name.event.empty()) continue;
      const auto source = static_cast<int>(scenario.sources.size());
      scenario.sources.emplace_back(figure_option);
      const auto column = static_cast<int>(question.figures[i].name.size() + 1 + name.offset) + 1;
      scenario.record.channels.push_back({name.text, {1, column, source}});
    }
  }
}

scenario::Scenario read(const PointQuestion& question, const std::vector<scenario::Override>& overrides,
                        Problems& problems) {
  auto all = question.set;
  all.insert(all.end(), overrides.begin(), overrides.end());
  return scenario::read_scenario_text(question.text, question.file, all, problems);
}

/// Only what is measured is left.
void strip(scenario::Scenario& scenario) {
  scenario.scene.title.clear();
  scenario.pictures = {};
  scenario.record.channels.clear();
}

/// The limits that a plot states for the length of the pieces.
std::optional<std::pair<double, double>> length_limits(const scenario::PicturesSection& pictures,
                                                       const std::string& source) {
  for (const auto& plot : pictures.plots)
    for (const auto& panel : plot.panels)
      if (panel.limits && panel.values.size() == 1 && panel.values[0].text == "length" &&
          (panel.event.text == plants::cut_event || panel.event.text == source + ".cut"))
        return panel.limits;
  return {};
}

/// Their middle.
double wanted_length(const scenario::PicturesSection& pictures, const std::string& source) {
  const auto limits = length_limits(pictures, source);
  return limits ? (limits->first + limits->second) / 2 : no_number;
}

/// What cuts, and from when on its pieces are looked at.
std::vector<PointQuestion::Piece> pieces_of(const std::vector<loop::KnownEvent>& events,
                                            const scenario::Scenario& scenario) {
  std::vector<PointQuestion::Piece> pieces;
  for (const auto& event : events) {
    if (event.name != plants::cut_event) continue;
    PointQuestion::Piece piece{event.source, 0, false, "", ""};
    if (const auto limits = length_limits(scenario.pictures, event.source))
      piece.tolerance = record::without_noise((limits->second - limits->first) / 2);
    for (const auto& [value, unit] : event.values) {
      if (value == "length") piece.length_unit = unit;
      piece.has_mismatch = piece.has_mismatch || value == "mismatch";
      if (value == "mismatch") piece.mismatch_unit = unit;
    }
    if (piece.length_unit.empty()) continue;
    const auto looks = std::find_if(
        scenario.checks.begin(), scenario.checks.end(), [&](const scenario::CheckRequest& check) {
          return (check.event.text == plants::cut_event || check.event.text == event.source + ".cut") &&
                 check.from > 0;
        });
    if (looks != scenario.checks.end()) piece.from = seconds(looks->from);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::vector<Column> columns_of(const PointQuestion& question, const std::vector<record::CheckResult>& checks,
                               const scenario::Scenario& scenario) {
  std::vector<Column> columns;
  for (const auto& piece : question.pieces) {
    const auto add = [&](const char* what, const std::string& name, const std::string& unit) {
      columns.push_back({piece_key(piece.source, what), piece.source + ".cut " + name, unit});
    };
    add("number", "number", "");
    add("mean_length", "mean length", piece.length_unit);
    add("accuracy", "accuracy", piece.length_unit);
    if (piece.has_mismatch) add("mismatch", "mismatch", piece.mismatch_unit);
  }
  for (const auto& drive : question.drives) {
    columns.push_back({drive_key(drive, "rms_torque"), drive + " rms torque", "N m"});
    columns.push_back({drive_key(drive, "peak_torque"), drive + " peak torque", "N m"});
    columns.push_back({drive_key(drive, "energy"), drive + " energy a cycle", "J"});
  }
  for (std::size_t i = 0; i < checks.size(); ++i) {
    const bool in_time =
        i < scenario.checks.size() && scenario.checks[i].kind == scenario::CheckRequest::Kind::eventually;
    const auto unit = in_time ? std::string("s") : checks[i].unit;
    columns.push_back(
        {std::string(margin_key) + checks[i].name, fmt::format("margin of {}", checks[i].name), unit});
  }
  for (const auto& figure : question.figures) columns.push_back({"figure." + figure.name, figure.name});
  if (!question.rated.empty())
    for (auto& column : rated_columns(question.rated)) columns.push_back(std::move(column));
  return columns;
}

/// Number of pieces, mean length, the largest distance of a length from the wanted one (from the mean where
/// none is said), the largest mismatch.
void add_pieces(const PointQuestion::Piece& piece, double wanted, const record::EventLog& events,
                std::vector<double>& numbers) {
  const auto values_of = [&](const char* value) {
    return loop::event_numbers(events, piece.source + ".cut", value, piece.from).numbers;
  };
  const auto lengths = values_of("length");
  const double mean = loop::statistics(lengths)[0];
  double accuracy = 0;
  for (const double length : lengths)
    accuracy = std::max(accuracy, std::abs(length - (std::isnan(wanted) ? mean : wanted)));
  numbers.push_back(static_cast<double>(lengths.size()));
  numbers.push_back(lengths.empty() ? no_number : mean);
  numbers.push_back(lengths.empty() ? no_number : record::without_noise(accuracy));
  if (!piece.has_mismatch) return;
  double worst = lengths.empty() ? no_number : 0;
  for (const double mismatch : values_of("mismatch")) worst = std::max(worst, std::abs(mismatch));
  numbers.push_back(worst);
}

void add_drive(const std::string& drive, const std::vector<record::DriveVerdict>& judged,
               std::vector<double>& numbers) {
  const auto found = std::find_if(judged.begin(), judged.end(), [&](const record::DriveVerdict& verdict) {
    return verdict.drive == drive;
  });
  const auto figure = [&](std::string_view name) {
    if (found != judged.end())
      for (const auto& one : found->figures)
        if (one.name == name && one.judged) return one.value;
    return no_number;
  };
  numbers.push_back(figure("rms torque"));
  numbers.push_back(figure("peak torque"));
  numbers.push_back(std::isnan(numbers[numbers.size() - 2]) ? no_number : found->energy);  // both of a cycle
}

/// The check that gave way first; those that are judged at the end come last, in the scenario's order.
const record::CheckResult* first_failed(const std::vector<record::CheckResult>& checks) {
  const record::CheckResult* first = nullptr;
  constexpr double end = std::numeric_limits<double>::infinity();
  for (const auto& check : checks)
    if (!check.passed && (first == nullptr || check.failed_at.value_or(end) < first->failed_at.value_or(end)))
      first = &check;
  return first;
}

PointRow row_without_run(PointRow::Verdict verdict, std::string limit, const PointQuestion& question) {
  return {verdict, std::move(limit), {}, std::vector<double>(question.columns.size(), no_number)};
}

}  // namespace

std::string piece_key(const std::string& source, std::string_view what) {
  return fmt::format("{}.cut.{}", source, what);
}
std::string drive_key(const std::string& drive, std::string_view what) {
  return fmt::format("{}.{}", drive, what);
}

std::string_view name_of(PointRow::Verdict verdict) { return verdicts.at(static_cast<std::size_t>(verdict)); }

std::string region_of(const PointRow& row) {
  if (row.verdict != PointRow::Verdict::failed || row.limit.empty()) return std::string(name_of(row.verdict));
  const auto rating = row.rating.substr(0, row.rating.find(": "));
  return rating.empty() ? row.limit : fmt::format("{}: {}", row.limit, rating);
}

std::string limit_of(const PointRow& row) {
  if (row.verdict == PointRow::Verdict::failed)
    return row.rating.empty() ? row.limit : fmt::format("{} ({})", row.limit, row.rating);
  return row.limit.empty() ? std::string(name_of(row.verdict))
                           : fmt::format("{}: {}", name_of(row.verdict), row.limit);
}

std::string counts_of(const std::vector<PointRow::Verdict>& all) {
  std::string text;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const auto count = std::count(all.begin(), all.end(), static_cast<PointRow::Verdict>(i));
    if (count > 0)
      text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, verdicts[i], verdict_notes[i]);
  }
  return text;
}

void prepare(PointQuestion& question, Problems& problems) {
  const auto before = problems.size();
  const auto whole = scenario::read_scenario_text(question.text, question.file, question.set, problems);
  if (!whole.buildable) return;
  loop::Simulation simulation(whole, problems);
  if (problems.size() != before) return;
  question.events = simulation.known_events();
  question.pieces = pieces_of(question.events, whole);
  for (const auto& drive : simulation.outcome().drives) question.drives.push_back(drive.drive);

  auto metrics = metrics_of(question, problems);
  Problems of_channels;
  auto measured = read(question, {}, of_channels);
  strip(measured);
  record_names(question, metrics, measured);
  loop::Simulation probe(measured, of_channels);
  for (auto& problem : of_channels) problems.push_back(std::move(problem));
  for (const auto& column : probe.recording().columns())
    question.units.emplace_back(column.name, column.unit);
  if (problems.size() != before) return;
  metrics_of(question, problems);  // now that units are known
  if (problems.size() != before) return;
  const auto checks = probe.outcome().checks;
  for (const auto& check : checks) question.checks.push_back(check.name);
  question.columns = columns_of(question, checks, measured);
}

PointScenario read_point(const PointQuestion& question, const std::vector<scenario::Override>& overrides) {
  PointScenario point;
  point.scenario = read(question, overrides, point.problems);
  loop::Fingerprint hash;
  hash.add_program();
  for (const auto& piece : question.pieces) {
    point.lengths.push_back(wanted_length(point.scenario.pictures, piece.source));
    hash.add(fmt::format("{} {} {}", piece.source, piece.from, point.lengths.back()));
  }
  strip(point.scenario);
  Problems ignored;  // prepare() has told them
  record_names(question, metrics_of(question, ignored), point.scenario);
  for (const auto& column : question.columns) hash.add(column.heading());
  for (const auto& figure : question.figures) hash.add(figure.term);
  for (const auto& problem : point.problems) hash.add(to_string(problem));
  if (point.problems.empty()) hash.add(point.scenario);
  point.fingerprint = hash.value();
  return point;
}

PointRow row_of(const PointQuestion& question, const std::vector<double>& lengths,
                const record::Outcome& outcome, const record::EventLog& events,
                const std::vector<double>& figures) {
  using Verdict = PointRow::Verdict;
  if (!outcome.failure.empty()) return row_without_run(Verdict::diverged, outcome.failure, question);
  PointRow row;
  for (std::size_t i = 0; i < question.pieces.size(); ++i)
    add_pieces(question.pieces[i], lengths[i], events, row.numbers);
  for (const auto& drive : question.drives) add_drive(drive, outcome.drives, row.numbers);
  // A name may have a variable in it: then the place in the list tells which check it is.
  for (std::size_t i = 0; i < question.checks.size(); ++i)
    row.numbers.push_back(i < outcome.checks.size() ? outcome.checks[i].margin.value_or(no_number)
                                                    : no_number);
  row.numbers.insert(row.numbers.end(), figures.begin(), figures.end());
  for (const auto& drive : outcome.drives)
    if (drive.drive == question.rated)
      for (const double number : rated_numbers(drive)) row.numbers.push_back(number);
  if (const auto* failed = first_failed(outcome.checks)) {
    row.verdict = Verdict::failed;
    row.limit = failed->name;
    if (failed->name == ratings_check) row.rating = failed_rating(outcome.drives);
  }
  return row;
}

PointRow run_point(const PointQuestion& question, const PointScenario& point) {
  using Verdict = PointRow::Verdict;
  const auto refused = [&](const Problems& problems) {
    const auto& first = problems.front();
    const auto why = fmt::format("{}; {}", first.what, first.remedy);
    return row_without_run(Verdict::refused, with_check_names(question, why), question);
  };
  if (!point.problems.empty()) return refused(point.problems);
  if (!point.scenario.buildable)
    return row_without_run(Verdict::refused, "no machine can be built of it", question);
  Problems problems;
  auto metrics = metrics_of(question, problems);
  loop::Simulation simulation(point.scenario, problems);
  if (!problems.empty()) return refused(problems);
  std::vector<Metric*> followed;
  for (auto& metric : metrics) followed.push_back(&metric);
  MetricSteps steps(simulation, followed, 0);
  const auto outcome = simulation.run();
  std::vector<double> figures;
  if (outcome.failure.empty())
    for (auto& metric : metrics) figures.push_back(metric.value(simulation.recording(), 0));
  return row_of(question, point.lengths, outcome, simulation.recording().events(), figures);
}

std::string with_check_names(const PointQuestion& question, const std::string& text) {
  static const std::regex by_number("checks[.]([0-9]+)");
  std::string named;
  auto rest = text.cbegin();
  for (std::sregex_iterator found(text.begin(), text.end(), by_number), end; found != end; ++found) {
    const auto number = number_of((*found)[1].str()).value_or(HUGE_VAL);
    const bool known = number < static_cast<double>(question.checks.size());
    named.append(rest, (*found)[0].first);
    named +=
        known ? fmt::format("checks[{}]", question.checks[static_cast<std::size_t>(number)]) : found->str();
    rest = (*found)[0].second;
  }
  return named.append(rest, text.cend());
}

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string row_text(const PointRow& row) {
  auto text =
      fmt::format("{},{},{}", name_of(row.verdict), csv_cell(in_one_line(row.limit)), csv_cell(row.rating));
  for (const double number : row.numbers)
    text += std::isnan(number) ? std::string(",") : fmt::format(",{:.9g}", number);
  return text;
}

std::optional<PointRow> parse_row(std::string_view text) {
  Problems ignored;
  cams::TableProblems broken("", ignored);
  const auto line = std::string(text) + "\n";
  CsvRows rows(line, broken);
  CsvRow cells;
  if (!rows.next(cells) || cells.cells.size() < 3) return {};
  const auto verdict = std::find(verdicts.begin(), verdicts.end(), cells.cells[0].text);
  if (verdict == verdicts.end()) return {};
  PointRow row{static_cast<PointRow::Verdict>(verdict - verdicts.begin()),
               cells.cells[1].text,
               cells.cells[2].text,
               {}};
  for (std::size_t i = 3; i < cells.cells.size(); ++i)
    row.numbers.push_back(number_of(cells.cells[i].text).value_or(no_number));
  return row;
}

}  // namespace drycut::sim::studies
