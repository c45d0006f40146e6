#include "sim/studies/tune/trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "sim/file.hpp"
#include "sim/parallel.hpp"
#include "sim/studies/compare/recorded_csv.hpp"
#include "sim/studies/fingerprint.hpp"

namespace drycut::sim::studies {

namespace {

std::string row_of(std::size_t number, const Trials::Trial& trial) {
  std::string row = fmt::format("{},{}", number, trial.phase);
  for (const double value : trial.point) row += fmt::format(",{}", value);
  const auto& verdict = trial.verdict;
  row += fmt::format(",{}", verdict.metric);
  for (const double room : verdict.room) row += fmt::format(",{}", room);
  return row + fmt::format(",{},{},{},{},{}\n", verdict.failed_checks, verdict.violation,
                           verdict.stopped ? 1 : 0, verdict.runs, csv_quoted(verdict.note));
}

}  // namespace

Trials::Trials(const Study& study, TunedParameters parameters, std::vector<scenario::Override> fixed,
               std::filesystem::path file, int jobs, std::function<void(int)> progress)
    : study_(study),
      parameters_(std::move(parameters)),
      fixed_(std::move(fixed)),
      file_(std::move(file)),
      jobs_(std::max(1, jobs)),
      progress_(std::move(progress)) {
  load();
  stream_.exceptions(std::ios::failbit | std::ios::badbit);
  stream_.open(file_, std::ios::binary | std::ios::app);
}

std::string Trials::fingerprint() const {
  Fingerprint hash;
  hash.add_program();
  hash.add("violations 2");  // how they are counted: rows of another way do not compare
  hash.add(study_.minimise);
  for (const auto& text : study_.constraints) hash.add(text);
  hash.add(fmt::format("{} {}", study_.from, study_.ignore_checks));
  if (study_.needs_loop)
    hash.add(fmt::format("{} {} {}", study_.loop.wire, study_.loop.at.value_or(""), study_.loop.amplitude));
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
  return line + ",failed_checks,violation,stopped,runs,note";
}

// Takes what an earlier run of the same study left; a line cut short ends it.
void Trials::load() {
  const auto first = fingerprint() + "\n" + heading() + "\n";
  std::string text = first;
  std::ifstream old(file_, std::ios::binary);
  std::ostringstream content;
  content << old.rdbuf();
  const std::string all = old ? content.str() : "";
  if (all.starts_with(first)) {
    const auto rest = std::string_view(all).substr(first.size(), all.rfind('\n') + 1 - first.size());
    Problems ignored;
    cams::TableProblems broken(file_.string(), ignored);
    CsvRows rows(rest, broken);
    for (CsvRow row; rows.next(row);) {
      const auto trial = trial_of(row);
      if (!trial) break;
      kept_.emplace(trial->point, trial->verdict);
      text += row_of(++rows_, *trial);
    }
  }
  write_file(file_, text);
}

std::optional<Trials::Trial> Trials::trial_of(const CsvRow& row) const {
  const std::size_t columns = 2 + parameters_.size() + 1 + study_.constraints.size() + 5;
  if (row.cells.size() != columns) return {};
  std::vector<double> numbers;
  for (std::size_t i = 2; i + 1 < columns; ++i) {
    const auto number = number_of(row.cells[i].text);
    if (!number) return {};
    numbers.push_back(*number);
  }
  const auto split = numbers.begin() + static_cast<std::ptrdiff_t>(parameters_.size());
  Trial trial{row.cells[1].text, Point(numbers.begin(), split), {}};
  auto& verdict = trial.verdict;
  verdict.metric = *split;
  verdict.room.assign(split + 1, numbers.end() - 4);
  verdict.failed_checks = static_cast<int>(numbers.end()[-4]);
  verdict.violation = numbers.end()[-3];
  verdict.stopped = numbers.end()[-2] != 0;
  verdict.runs = static_cast<int>(numbers.end()[-1]);
  verdict.note = row.cells.back().text;
  return trial;
}

void Trials::append(const Trial& trial) {
  stream_ << row_of(++rows_, trial) << std::flush;
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
  std::vector<bool> done(open.size());
  std::size_t written = 0;
  int runs_done = runs();
  std::mutex mutex;
  for_each_index(open.size(), jobs_, [&](std::size_t i) {
    auto& trial = trials_[open[i]];
    auto overrides = fixed_;
    for (auto& override : overrides_of(parameters_, trial.point)) overrides.push_back(std::move(override));
    trial.verdict = measure(study_, overrides, to_beat);
    const std::lock_guard lock(mutex);
    done[i] = true;
    while (written < open.size() && done[written]) {
      runs_done += trials_[open[written]].verdict.runs;
      append(trials_[open[written++]]);
    }
    if (progress_) progress_(runs_done);
  });
  return indices;
}

int Trials::runs() const {
  return std::accumulate(trials_.begin(), trials_.end(), 0,
                         [](int sum, const Trial& trial) { return sum + trial.verdict.runs; });
}

std::size_t Trials::best() const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < trials_.size(); ++i)
    if (trials_[i].verdict.rank() < trials_[best].verdict.rank()) best = i;
  return best;
}

}  // namespace drycut::sim::studies
