#pragma once
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "sim/record/event_log.hpp"
#include "sim/record/series.hpp"
#include "sim/time.hpp"

namespace drycut::sim::record {

/// What a run leaves behind: channels over time and events. However long the run, it takes little memory:
/// what is old waits in a file without a name.
class Recording {
 public:
  struct Column {
    std::string name;
    std::string unit;
    const double* slot;  ///< where sample() takes it from, if it does
    Series<double> values;
  };

  Recording() = default;
  Recording(Recording&&) = default;
  Recording& operator=(Recording&&) = default;

  /// Adds a channel that is not sampled: append() or the caller fills it. Before that column of the name, if
  /// there is one, keeps the name.
  Column& add(std::string name, std::string unit);
  /// Where the file without a name is; the system's temporary folder unless it is said before the first row.
  void spool_in(const std::filesystem::path& folder) { spool_->lies_in(folder); }
  /// From now on rows and events are only passed on, not kept.
  void keep_nothing() { kept_ = false; }
  [[nodiscard]] bool keeps() const { return kept_; }

  /// Takes the slots' present values. Throws std::runtime_error if there is no room.
  void sample(Time time);
  /// Takes a row with a number a column.
  void append(Time time, const std::vector<double>& row);
  void happened(const RecordedEvent& event) { events_.push_back(event); }
  void forget_events() { events_.clear(); }

  [[nodiscard]] const Series<Time>& times() const { return times_; }
  [[nodiscard]] const std::deque<Column>& columns() const { return columns_; }
  [[nodiscard]] const Column* column(const std::string& name) const;
  [[nodiscard]] const EventLog& events() const { return events_; }

 private:
  std::shared_ptr<Spool> spool_ = std::make_shared<Spool>();
  Series<Time> times_ = Series<Time>(spool_);
  std::deque<Column> columns_;
  std::unordered_map<std::string, std::size_t> index_;  ///< of the columns
  EventLog events_;
  bool kept_ = true;
};

/// "12.0004": a time in seconds, exact.
std::string seconds_text(Time time);
/// A number to print: 0 where it is nothing but rounding noise, closer to 0 than 1e-9 in its unit.
double without_noise(double number);
/// `name=number unit; ...` or the event's text, as events.csv and the report show it.
std::string values_text(const RecordedEvent& event, int digits = 9);

}  // namespace drycut::sim::record
