#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/time.hpp"
#include "sim/watch.hpp"

namespace drycut::sim {

/// Something that happened: in a plant, in the controller, in the timeline.
struct RecordedEvent {
  struct Value {
    std::string name;
    double number = 0;
    std::string unit;
  };
  Time time = 0;
  double within = 0;   ///< [s] to add to `time`: events lie inside steps
  std::string source;  ///< plant, device, task or "timeline"
  std::string event;
  std::vector<Value> values;
  std::string text;

  [[nodiscard]] double at_seconds() const { return seconds(time) + within; }
  [[nodiscard]] const Value* find(const std::string& name) const;
};

/// What a run leaves behind: channels over time and events.
class Recording {
 public:
  struct Column {
    std::string name;
    std::string unit;
    const double* slot;
    std::vector<double> values;
  };

  /// A recording that was read back from its files: columns as long as `times`. Nothing is sampled into it.
  static Recording restored(std::vector<Time> times, std::vector<Column> columns);

  /// Adds a channel; false if nothing has this name. A channel added twice is recorded once.
  bool add(Watch& watch, const std::string& name);
  void reserve(std::size_t rows);
  /// Takes the slots' present values.
  void sample(Time time);
  void happened(RecordedEvent event) { events_.push_back(std::move(event)); }

  [[nodiscard]] const std::vector<Time>& times() const { return times_; }
  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] const Column* column(const std::string& name) const;
  [[nodiscard]] const std::vector<RecordedEvent>& events() const { return events_; }

 private:
  std::vector<Time> times_;
  std::vector<Column> columns_;
  std::vector<RecordedEvent> events_;
};

/// "12.0004": a time in seconds, exact.
std::string seconds_text(Time time);
/// A number to print: 0 where it is nothing but rounding noise, closer to 0 than 1e-9 in its unit.
double without_noise(double number);
/// `name=number unit; ...` or the event's text, as events.csv and the report show it.
std::string values_text(const RecordedEvent& event, int digits = 9);

/// trace.csv and events.csv (design §6). Throw std::runtime_error if the file cannot be written.
void write_trace(const Recording& recording, const std::filesystem::path& file);
void write_events(const Recording& recording, const std::filesystem::path& file);

}  // namespace drycut::sim
