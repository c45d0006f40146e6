#include "sim/studies/faults/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/json.hpp"
#include "base/text.hpp"
#include "sim/loop/files_read.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/record/json.hpp"
#include "sim/studies/kept_lines.hpp"
#include "sim/studies/override_json.hpp"

namespace drycut::sim::studies {

namespace {

/// Lines at which faults are tried, one a thread, made as they are needed.
class Benches {
 public:
  explicit Benches(const FaultQuestion& question) : question_(question) {}

  FaultCell cell(std::size_t fault, std::size_t when) {
    auto bench = take();
    auto cell = bench->cell(question_, question_.faults.at(fault), question_.when.at(when));
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(bench));
    return cell;
  }

 private:
  std::unique_ptr<FaultBench> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        auto bench = std::move(idle_.back());
        idle_.pop_back();
        return bench;
      }
    }
    Problems problems;
    auto bench = std::make_unique<FaultBench>(*question_.scenario, problems);
    if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
    return bench;
  }

  const FaultQuestion& question_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<FaultBench>> idle_;
};

/// Which cell is asked for.
struct CellAsk {
  std::size_t fault = 0;
  std::size_t when = 0;

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("fault", self.fault);
    archive("when", self.when);
  }
};

FaultCell cell_in(std::string_view text) {
  FaultCell cell;
  record::take_json(json_from(text), cell);
  return cell;
}

/// All that a cell depends on.
std::string fingerprint(const FaultQuestion& question) {
  loop::Fingerprint hash;
  hash.add_program();
  hash.add(*question.scenario);
  hash.add(json_text(record::json_of(question)));
  for (const auto& moment : question.when) hash.add(fmt::format("{} {}", moment.at, moment.until));
  return fmt::format("# drycut faults, study {:016x}\n", hash.value());
}

/// Reads all that cells read, for whoever works elsewhere.
void read_files(const FaultQuestion& question) {
  Problems ignored;
  const auto scenario = scenario::read_scenario_text(question.text, question.file, question.set, ignored);
  std::ignore = loop::read_files_of(scenario);
}

constexpr int most_parts = 5;  ///< of a fault's moments that are listed

std::string seconds_word(double time) { return fmt::format("{:.3g} s", time); }

}  // namespace

FaultMatrix try_faults(const FaultQuestion& question, const std::filesystem::path& file,
                       const cluster::Workers& workers,
                       const std::function<void(std::size_t done, std::size_t of)>& progress) {
  FaultMatrix matrix;
  const auto count = question.cells();
  matrix.cells.resize(count);
  matrix.accepted.resize(count);
  std::map<std::size_t, std::string> known;
  KeptLines lines(file, fingerprint(question), [&](std::string_view line) -> std::string {
    const auto comma = line.find(',');
    const auto number = parsed<std::size_t>(line.substr(0, comma));
    if (!number || *number >= count) return {};
    known[*number] = line.substr(comma + 1);
    return std::string(line);
  });
  Benches benches(question);
  std::mutex mutex;
  std::size_t done = 0;
  const auto moments = question.when.size();
  const auto ask = [&](std::size_t i) -> std::optional<cluster::Ask> {
    if (i == 0) read_files(question);
    if (const auto found = known.find(i); found != known.end()) {
      const std::lock_guard lock(mutex);
      matrix.cells[i] = cell_in(found->second);
      progress(++done, count);
      return {};
    }
    const CellAsk asked{i / moments, i % moments};
    return cluster::Ask{json_text(record::json_of(asked)), [&benches, asked] {
                          return json_text(record::json_of(benches.cell(asked.fault, asked.when)));
                        }};
  };
  const auto take = [&](std::size_t i, const cluster::WorkerAnswer& answer) {
    const std::lock_guard lock(mutex);
    if (answer.lost.empty()) {
      matrix.cells[i] = cell_in(answer.text);
      lines.add(fmt::format("{},{}", i, answer.text));
      ++matrix.simulated;
    } else {
      matrix.cells[i].kind = FaultCell::Kind::lost;
      matrix.cells[i].harm = answer.lost;
      matrix.lost.push_back(fmt::format("{} at {} was lost: {}", question.faults[i / moments].full(),
                                        question.when[i % moments].name, answer.lost));
    }
    progress(++done, count);
  };
  workers.run({"fault", json_text(record::json_of(question)), count, ask, take});
  return matrix;
}

std::vector<Finding> accept_cells(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                                  FaultMatrix& matrix) {
  std::vector<Finding> findings;
  for (std::size_t entry = 0; entry < entries.size(); ++entry) {
    bool used = false;
    for (std::size_t i = 0; i < matrix.cells.size(); ++i) {
      const auto& fault = question.faults[i / question.when.size()];
      const auto& when = question.when[i % question.when.size()];
      if (!entries[entry].covers(fault, when, matrix.cells[i])) continue;
      used = true;
      if (!matrix.accepted[i]) matrix.accepted[i] = entry;
    }
    if (!used)
      findings.emplace_back("faults.accepts-nothing"_code,
                            fmt::format("the accepted cells of line {} are none: of {}, at '{}', none is {}",
                                        entries[entry].line, entries[entry].fault, entries[entry].when,
                                        record::word_of(entries[entry].cell)));
  }
  return findings;
}

Table faults_table(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                   const FaultMatrix& matrix) {
  Table table({{"fault", "fault"},
               {"value", "value"},
               {"when", "when"},
               {"at", "at", "s"},
               {"cell", "cell"},
               {"accepted", "accepted"},
               {"told_by", "told by"},
               {"told_after", "told after", "s"},
               {"harm", "harm"},
               {"harm_after", "harm after", "s"},
               {"cuts", "cuts"},
               {"goes_on", "goes on"}});
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < matrix.cells.size(); ++i) {
    const auto& fault = question.faults[i / question.when.size()];
    const auto& moment = question.when[i % question.when.size()];
    const auto& cell = matrix.cells[i];
    table.add({fault.full(), fault.quantity(), moment.name, seconds(moment.at),
               std::string(record::word_of(cell.kind)),
               matrix.accepted[i] ? entries[*matrix.accepted[i]].why : "", cell.told_by,
               cell.told_after.value_or(none), cell.harm, cell.harm_after.value_or(none),
               static_cast<double>(cell.cuts), cell.goes_on ? 1.0 : 0.0});
  }
  return table;
}

std::vector<FaultStretch> stretches_of(const FaultQuestion& question, const FaultMatrix& matrix,
                                       std::size_t fault) {
  std::vector<FaultStretch> all;
  const auto moments = question.when.size();
  for (std::size_t when = 0; when < moments;) {
    const auto cell = fault * moments + when;
    const auto alike = [&](std::size_t other) {
      return question.when[other].phase.has_value() == question.when[when].phase.has_value() &&
             matrix.cells[fault * moments + other].kind == matrix.cells[cell].kind &&
             matrix.accepted[fault * moments + other].has_value() == matrix.accepted[cell].has_value();
    };
    auto end = when + 1;
    while (end < moments && question.when[end].phase && alike(end)) ++end;
    const auto& first = question.when[when];
    auto text = first.name;
    if (end > when + 1) text = fmt::format("{:.4g}..{}", *first.phase, question.when[end - 1].name);
    const auto same = std::ranges::find_if(all, [&](const FaultStretch& stretch) {
      return stretch.kind == matrix.cells[cell].kind && stretch.accepted == matrix.accepted[cell].has_value();
    });
    const auto count = static_cast<int>(end - when);
    if (same == all.end()) {
      all.push_back({matrix.cells[cell].kind, matrix.accepted[cell].has_value(), text, when, count});
    } else {
      if (++same->parts <= most_parts) same->when += ", " + text;
      if (same->parts == most_parts + 1) same->when += ", ...";
      same->count += count;
    }
    when = end;
  }
  return all;
}

Prose text_of(FaultCell::Kind kind) {
  switch (kind) {
    case FaultCell::Kind::unharmed:
      return "unharmed";
    case FaultCell::Kind::told:
      return "told in time";
    case FaultCell::Kind::wrong:
      return "wrong product, nobody told";
    case FaultCell::Kind::damage:
      return "damage";
    case FaultCell::Kind::stopped:
      return "the simulation failed";
    case FaultCell::Kind::lost:
      return "lost";
  }
  return "";
}

std::string text_of(const FaultCell& cell) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (cell.harm_after)
    add(fmt::format("{} {} later", cell.detail.empty() ? cell.harm : fmt::format("'{}' fails", cell.harm),
                    seconds_word(*cell.harm_after)));
  if (cell.told_after) add(fmt::format("told by {} {} later", cell.told_by, seconds_word(*cell.told_after)));
  if (cell.kind == FaultCell::Kind::damage && !cell.told_after) add("nobody told");
  if (cell.kind == FaultCell::Kind::told) add(cell.goes_on ? "it goes on" : "it stops");
  return text;
}

std::function<std::string(const std::string&)> fault_answerer(const std::string& text) {
  const auto question = question_in<FaultQuestion>(text);
  const auto benches = std::make_shared<Benches>(*question);
  return [question, benches](const std::string& ask) {
    CellAsk asked;
    record::take_json(json_from(ask), asked);
    return json_text(record::json_of(benches->cell(asked.fault, asked.when)));
  };
}

}  // namespace drycut::sim::studies
