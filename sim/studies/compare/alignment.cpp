#include "sim/studies/compare/alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>

#include "base/text.hpp"
#include "sim/loop/known_events.hpp"

namespace drycut::sim::studies {

namespace {

/// A recording of the same channels, but those that are `left`, with rows and events of its own.
record::Recording empty_like(const record::Recording& recording,
                             const std::function<bool(const std::string&)>& left) {
  record::Recording made;
  for (const auto& column : recording.columns())
    if (!left(column.name)) made.add(column.name, column.unit);
  return made;
}

/// Copies rows into a recording of the same channels, or of some of them.
class RowCopy {
 public:
  RowCopy(const record::Recording& from, record::Recording& to) : to_(to), numbers_(to.columns().size()) {
    for (const auto& column : to.columns()) sources_.push_back(from.column(column.name));
  }
  void add(std::size_t row, Time at) {
    for (std::size_t i = 0; i < sources_.size(); ++i) numbers_[i] = sources_[i]->values[row];
    to_.append(at, numbers_);
  }

 private:
  record::Recording& to_;
  std::vector<const record::Recording::Column*> sources_;
  std::vector<double> numbers_;
};

/// When the stretches of a run begin; the first at 0.
std::vector<Time> stretches_of(const ComparedRun& run, const std::string& mark) {
  const auto& recording = run.recording;
  std::vector<Time> begins = {0};
  for (const auto& event : recording.events())
    if (loop::names_event(mark, event.source, event.event)) begins.push_back(event.time);
  const auto* column = recording.column(mark);
  if (begins.size() > 1 || column == nullptr) return begins;
  for (std::size_t row = 1; row < column->values.size(); ++row)
    if (column->values[row] != column->values[row - 1]) begins.push_back(recording.times()[row]);
  return begins;
}

/// Number of the stretch that a time is in.
std::size_t stretch_at(const std::vector<Time>& begins, Time at) {
  return static_cast<std::size_t>(std::upper_bound(begins.begin(), begins.end(), at) - begins.begin()) - 1;
}

/// The row nearest to a time, of those that begin with `first` and end before `end`.
std::size_t nearest_row(const record::Series<Time>& times, Time at, Time first, Time end) {
  const auto from = std::lower_bound(times.begin(), times.end(), first) - times.begin();
  const auto until = std::lower_bound(times.begin(), times.end(), end) - times.begin();
  auto row = std::lower_bound(times.begin(), times.end(), at) - times.begin();
  if (row > 0 && (row == until || at - times.begin()[row - 1] < times.begin()[row] - at)) --row;
  return static_cast<std::size_t>(std::clamp(row, from, std::max(from, until - 1)));
}

record::Recording laid_over(const ComparedRun& first, const std::vector<Time>& first_begins,
                            const ComparedRun& run, const std::vector<Time>& begins) {
  const auto& old = run.recording;
  auto laid = empty_like(old, [](const std::string&) { return false; });
  RowCopy copy(old, laid);
  const Time past = old.times().back() + 1;
  for (const Time at : first.recording.times()) {
    const auto stretch = std::min(stretch_at(first_begins, at), begins.size() - 1);
    const Time end = stretch + 1 < begins.size() ? begins[stretch + 1] : past;
    copy.add(nearest_row(old.times(), at - first_begins[stretch] + begins[stretch], begins[stretch], end),
             at);
  }
  for (auto event : old.events()) {
    const auto stretch = stretch_at(begins, event.time);
    if (stretch < first_begins.size()) event.time += first_begins[stretch] - begins[stretch];
    laid.happened(event);
  }
  return laid;
}

}  // namespace

bool is_named(const std::string& wanted, const std::string& channel) {
  if (!wanted.ends_with('*')) return wanted == channel;
  return channel.starts_with(std::string_view(wanted).substr(0, wanted.size() - 1));
}

void leave_out(std::vector<ComparedRun>& runs, const std::vector<std::string>& names, Problems& problems) {
  std::vector<std::string> known;
  for (const auto& run : runs)
    for (const auto& column : run.recording.columns()) known.push_back(column.name);
  for (const auto& name : names)
    if (std::none_of(known.begin(), known.end(), [&](const auto& one) { return is_named(name, one); }))
      problems.push_back({"compare.tolerance"_code, "--without", 1, 1,
                          fmt::format("no run has a channel '{}'", name),
                          did_you_mean(name, known, "Axis.* is all of an axis")});
  if (names.empty() || !problems.empty()) return;
  for (auto& run : runs) {
    auto kept = empty_like(run.recording, [&](const std::string& channel) {
      return std::any_of(names.begin(), names.end(),
                         [&](const std::string& name) { return is_named(name, channel); });
    });
    RowCopy copy(run.recording, kept);
    for (std::size_t row = 0; row < run.recording.times().size(); ++row)
      copy.add(row, run.recording.times()[row]);
    for (const auto& event : run.recording.events()) kept.happened(event);
    run.recording = std::move(kept);
  }
}

void align(std::vector<ComparedRun>& runs, const std::string& mark, Problems& problems) {
  if (mark.empty() || !problems.empty()) return;
  std::vector<std::vector<Time>> begins;
  for (const auto& run : runs) {
    begins.push_back(stretches_of(run, mark));
    if (begins.back().size() > 1 && !run.recording.times().empty()) continue;
    problems.push_back(
        {"compare.unknown-name"_code, "--align", 1, 1,
         fmt::format("'{}' is no event of {}, and no channel that changes there", mark, run.label),
         "name an event, such as cut, or a recorded channel that counts, such as gbPlace"});
  }
  if (!problems.empty()) return;
  for (std::size_t i = 1; i < runs.size(); ++i)
    runs[i].recording = laid_over(runs.front(), begins.front(), runs[i], begins[i]);
}

}  // namespace drycut::sim::studies
