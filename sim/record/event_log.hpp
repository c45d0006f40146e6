#pragma once
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/severity.hpp"
#include "sim/record/series.hpp"
#include "sim/time.hpp"

namespace drycut::sim::record {

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
  Severity severity = Severity::note;

  [[nodiscard]] double at_seconds() const { return seconds(time) + within; }
  [[nodiscard]] const Value* find(const std::string& name) const;
};

/// Events in their order. Words are kept once, so that one of a hundred thousand cuts takes 64 bytes.
class EventLog {
 public:
  using value_type = RecordedEvent;
  using const_iterator = IndexIterator<EventLog>;
  using iterator = const_iterator;

  EventLog() = default;
  EventLog(EventLog&&) = default;
  EventLog& operator=(EventLog&&) = default;

  void push_back(const RecordedEvent& event);
  /// Forgets the events. Their kinds stay: there are few of them.
  void clear();
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] RecordedEvent operator[](std::size_t i) const;
  [[nodiscard]] RecordedEvent front() const { return (*this)[0]; }
  [[nodiscard]] RecordedEvent back() const { return (*this)[size() - 1]; }
  [[nodiscard]] const_iterator begin() const { return {this, 0}; }
  [[nodiscard]] const_iterator end() const { return {this, size()}; }

 private:
  struct Kind {  ///< an event without its numbers
    std::string source;
    std::string event;
    std::vector<std::pair<std::string, std::string>> values;  ///< name, unit
    Severity severity;
    bool operator<(const Kind& other) const;
  };
  struct Entry {
    Time time;
    double within;
    const Kind* kind;
    const std::string* text;
    std::size_t numbers;  ///< where its numbers begin
  };

  // Entries point at the words: elements of a set keep their places.
  std::set<Kind> kinds_;
  std::set<std::string> texts_;
  std::vector<Entry> entries_;
  std::vector<double> numbers_;
};

}  // namespace drycut::sim::record
