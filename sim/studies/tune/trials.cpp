#include "sim/studies/tune/trials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

#include "base/json.hpp"
#include "base/text.hpp"
#include "sim/loop/files_read.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/studies/override_json.hpp"
#include "sim/studies/recorded_csv.hpp"

namespace drycut::sim::studies {

namespace {

using Overrides = std::vector<scenario::Override>;

/// A verdict as the cells of a row behind the values, the same way and back: numbers keep every digit.
std::string text_of(const Verdict& verdict) {
  auto row = fmt::format("{}", verdict.metric);
  for (const double room : verdict.room) row += fmt::format(",{}", room);
  return row + fmt::format(",{},{},{},{},{},{},{}", verdict.hunts_from, verdict.failed_checks,
                           verdict.violation, verdict.stopped ? 1 : 0, verdict.doubtful ? 1 : 0, verdict.runs,
                           csv_quoted(verdict.note));
}

std::optional<Verdict> verdict_of(std::span<const CsvRow::Cell> cells, std::size_t rooms) {
  if (cells.size() != 1 + rooms + 7) return {};
  std::vector<double> numbers;
  for (const auto& cell : cells.first(cells.size() - 1)) {
    const auto number = number_of(cell.text);
    if (!number) return {};
    numbers.push_back(*number);
  }
  Verdict verdict;
  verdict.metric = numbers.front();
  verdict.room.assign(numbers.begin() + 1, numbers.end() - 6);
  verdict.hunts_from = numbers.end()[-6];
  verdict.failed_checks = static_cast<int>(numbers.end()[-5]);
  verdict.violation = numbers.end()[-4];
  verdict.stopped = numbers.end()[-3] != 0;
  verdict.doubtful = numbers.end()[-2] != 0;
  verdict.runs = static_cast<int>(numbers.end()[-1]);
  verdict.note = cells.back().text;
  return verdict;
}

std::optional<Verdict> parsed_verdict(const std::string& text, std::size_t rooms) {
  Problems ignored;
  cams::TableProblems broken("", ignored);
  const auto line = text + "\n";
  CsvRows rows(line, broken);
  CsvRow row;
  return rows.next(row) ? verdict_of(row.cells, rooms) : std::nullopt;
}

std::string row_of(std::size_t number, const Trials::Trial& trial) {
  std::string row = fmt::format("{},{}", number, trial.phase);
  for (const double value : trial.point) row += fmt::format(",{}", value);
  return row + "," + text_of(trial.verdict);
}

/// What is asked of one trial.
struct TrialAsk {
  Overrides overrides;
  std::optional<double> to_beat;

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("overrides", self.overrides);
    archive("to_beat", self.to_beat);
  }
};

std::string answer_of(const Study& study, const TrialAsk& ask) {
  return text_of(
      measure(study, ask.overrides, ask.to_beat.value_or(std::numeric_limits<double>::infinity())));
}

/// Reads all that the trials read; their values, numbers, name no files.
void read_cases(const Study& study) {
  for (const auto& entry : study.cases) {
    Problems ignored;
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, study.set, ignored);
    std::ignore = loop::read_files_of(scenario);
  }
}

}  // namespace

Trials::Trials(const Study& study, TunedParameters parameters, std::vector<scenario::Override> fixed,
               const std::filesystem::path& file, cluster::Workers workers, std::function<void(int)> progress)
    : study_(study),
      parameters_(std::move(parameters)),
      fixed_(std::move(fixed)),
      workers_(std::move(workers)),
      progress_(std::move(progress)),
      lines_(file, fingerprint() + "\n" + heading() + "\n", [this](std::string_view line) -> std::string {
        const auto trial = trial_of(line);
        if (!trial) return {};
        kept_.emplace(trial->point, trial->verdict);
        return row_of(++rows_, *trial);
      }) {}

std::string Trials::fingerprint() const {
  loop::Fingerprint hash;
  hash.add_program();
  hash.add("violations 3");  // how they are counted: rows of another way do not compare
  hash.add(study_.minimise);
  for (const auto& text : study_.constraints) hash.add(text);
  hash.add(fmt::format("{} {}", study_.from, study_.ignore_checks));
  if (study_.needs_loop)
    hash.add(fmt::format("{} {} {}", study_.loop.wire, study_.loop.at.value_or(""), study_.loop.sine()));
  for (const auto& override : fixed_) hash.add(override.path + "=" + override.value);
  for (const auto& entry : study_.cases) {
    Problems problems;
    const auto scenario = scenario::read_scenario_text(entry.text, entry.file, study_.set, problems);
    hash.add(scenario);
  }
  return fmt::format("# drycut tune, study {:016x}", hash.value());
}

std::string Trials::heading() const {
  std::string line = "trial,phase";
  for (const auto& p : parameters_)
    line += "," + csv_quoted(p.unit.empty() ? p.path : fmt::format("{} [{}]", p.path, p.unit));
  line += "," + csv_quoted(study_.minimise);
  for (const auto& text : study_.constraints) line += "," + csv_quoted("room of " + text);
  return line + ",hunts_from,failed_checks,violation,stopped,doubtful,runs,note,checksum";
}

std::optional<Trials::Trial> Trials::trial_of(std::string_view line) const {
  Problems ignored;
  cams::TableProblems broken("", ignored);
  const auto text = std::string(line) + "\n";
  CsvRows rows(text, broken);
  CsvRow row;
  if (!rows.next(row)) return {};
  const auto values = 2 + parameters_.size();
  if (row.cells.size() < values) return {};
  Trial trial{row.cells[1].text, {}, {}};
  for (std::size_t i = 2; i < values; ++i) {
    const auto number = number_of(row.cells[i].text);
    if (!number) return {};
    trial.point.push_back(*number);
  }
  auto verdict = verdict_of(std::span(row.cells).subspan(values), study_.constraints.size());
  if (!verdict) return {};
  trial.verdict = std::move(*verdict);
  return trial;
}

void Trials::append(const Trial& trial) {
  lines_.add(row_of(++rows_, trial));
  ++simulated_;
}

std::vector<std::size_t> Trials::run(const std::string& phase, const std::vector<Point>& points,
                                     double to_beat) {
  std::vector<std::size_t> indices;
  std::vector<std::size_t> open;
  for (const auto& point : points) {
    const auto [entry, fresh] = index_.emplace(point, trials_.size());
    indices.push_back(entry->second);
    if (!fresh) continue;
    trials_.push_back({phase, point, {}});
    const auto kept = kept_.find(point);
    if (kept == kept_.end()) {
      open.push_back(entry->second);
    } else {
      trials_.back().verdict = kept->second;
    }
  }
  // Rows go into the file in order, whoever finishes first.
  std::vector<std::string> came(open.size());  // "" = not yet
  std::size_t written = 0;
  int runs_done = runs();
  const auto ask = [&](std::size_t i) {
    if (i == 0) read_cases(study_);
    TrialAsk asked{fixed_, std::isfinite(to_beat) ? std::optional(to_beat) : std::nullopt};
    for (auto& override : overrides_of(parameters_, trials_[open[i]].point))
      asked.overrides.push_back(std::move(override));
    return std::optional(
        cluster::Ask{json_text(record::json_of(asked)), [this, asked] { return answer_of(study_, asked); }});
  };
  const auto take = [&](std::size_t i, const cluster::WorkerAnswer& answer) {
    auto& trial = trials_[open[i]];
    came[i] = answer.lost.empty() ? answer.text : "lost";
    if (answer.lost.empty()) {
      trial.verdict = parsed_verdict(answer.text, study_.constraints.size()).value();
    } else {
      trial.verdict.stopped = true;
      trial.verdict.note = answer.lost;
      trial.verdict.metric = std::numeric_limits<double>::quiet_NaN();
      trial.verdict.room.assign(study_.constraints.size(), std::numeric_limits<double>::quiet_NaN());
      lost_.push_back(fmt::format("{} was lost: {}", fmt::join(trial.point, ", "), answer.lost));
    }
    for (; written < open.size() && !came[written].empty(); ++written) {
      runs_done += trials_[open[written]].verdict.runs;
      if (came[written] != "lost") append(trials_[open[written]]);
    }
    if (progress_) progress_(runs_done);
  };
  workers_.run({"trial", json_text(record::json_of(study_)), open.size(), ask, take});
  return indices;
}

int Trials::runs() const {
  return std::accumulate(trials_.begin(), trials_.end(), 0,
                         [](int sum, const Trial& trial) { return sum + trial.verdict.runs; });
}

int Trials::loop_runs() const {
  const auto plain = static_cast<int>(study_.cases.size());
  return std::accumulate(trials_.begin(), trials_.end(), 0, [&](int sum, const Trial& trial) {
    return sum + std::max(0, trial.verdict.runs - plain);
  });
}

std::size_t Trials::best() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < trials_.size(); ++i)
    if (trials_[i].verdict.rank() < trials_[best].verdict.rank()) best = i;
  return best;
}

std::function<std::string(const std::string&)> trial_answerer(const std::string& text) {
  const auto study = question_in<Study>(text);
  return [study](const std::string& ask) {
    TrialAsk asked;
    record::take_json(json_from(ask), asked);
    return answer_of(*study, asked);
  };
}

}  // namespace drycut::sim::studies
