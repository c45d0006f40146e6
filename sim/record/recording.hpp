#pragma once
#include <drycut/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/time.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::sim::record {

/// A file without a name for what would fill the memory; it is gone when the program ends, however it ends.
class Spool {
 public:
  Spool() = default;
  ~Spool();
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  /// The folder of the file, which is made at the first write; else it is the system's temporary one.
  void lies_in(std::filesystem::path folder) { folder_ = std::move(folder); }
  /// Appends and returns where. Throws std::runtime_error if there is no room.
  std::int64_t write(const void* bytes, std::size_t size);
  /// Throws std::runtime_error if it cannot be read back.
  void read(std::int64_t place, void* bytes, std::size_t size) const;

 private:
  void open();

  std::filesystem::path folder_;
  int file_ = -1;
  std::int64_t size_ = 0;
};

/// Reads a container that gives its elements by value, one index after the other.
template <typename Container>
class IndexIterator {
 public:
  using iterator_category = std::random_access_iterator_tag;
  using value_type = typename Container::value_type;
  using difference_type = std::ptrdiff_t;
  using pointer = const value_type*;
  using reference = value_type;

  IndexIterator() = default;
  IndexIterator(const Container* of, std::size_t at) : of_(of), at_(static_cast<std::ptrdiff_t>(at)) {}
  value_type operator*() const { return (*of_)[static_cast<std::size_t>(at_)]; }
  value_type operator[](std::ptrdiff_t by) const { return *(*this + by); }
  IndexIterator& operator+=(std::ptrdiff_t by) {
    at_ += by;
    return *this;
  }
  IndexIterator& operator-=(std::ptrdiff_t by) { return *this += -by; }
  IndexIterator& operator++() { return *this += 1; }
  IndexIterator& operator--() { return *this += -1; }
  IndexIterator operator++(int) {
    const auto old = *this;
    ++at_;
    return old;
  }
  IndexIterator operator--(int) {
    const auto old = *this;
    --at_;
    return old;
  }
  friend IndexIterator operator+(IndexIterator a, std::ptrdiff_t by) { return a += by; }
  friend IndexIterator operator+(std::ptrdiff_t by, IndexIterator a) { return a += by; }
  friend IndexIterator operator-(IndexIterator a, std::ptrdiff_t by) { return a -= by; }
  friend std::ptrdiff_t operator-(const IndexIterator& a, const IndexIterator& b) { return a.at_ - b.at_; }
  friend bool operator==(const IndexIterator& a, const IndexIterator& b) { return a.at_ == b.at_; }
  friend bool operator!=(const IndexIterator& a, const IndexIterator& b) { return a.at_ != b.at_; }
  friend bool operator<(const IndexIterator& a, const IndexIterator& b) { return a.at_ < b.at_; }
  friend bool operator>(const IndexIterator& a, const IndexIterator& b) { return a.at_ > b.at_; }
  friend bool operator<=(const IndexIterator& a, const IndexIterator& b) { return a.at_ <= b.at_; }
  friend bool operator>=(const IndexIterator& a, const IndexIterator& b) { return a.at_ >= b.at_; }

 private:
  const Container* of_ = nullptr;
  std::ptrdiff_t at_ = 0;
};

/// A column that only grows, of any length: full blocks go to a spool, one of them is held at a time. Made
/// to be read from one end to the other; not by two threads at once.
template <typename Number>
class Series {
 public:
  using value_type = Number;
  using const_iterator = IndexIterator<Series>;
  using iterator = const_iterator;
  static constexpr std::size_t block = 1U << 15U;  ///< numbers; a column shorter than this needs no file

  explicit Series(std::shared_ptr<Spool> spool = std::make_shared<Spool>()) : spool_(std::move(spool)) {}

  void push_back(Number number) {
    if (tail_.size() == block) put_away();
    tail_.push_back(number);
  }
  [[nodiscard]] std::size_t size() const { return places_.size() * block + tail_.size(); }
  /// Leaves so many at the beginning, at most as many as there are.
  void shorten(std::size_t size) {
    if (const auto blocks = size / block; blocks < places_.size()) {
      if (size % block > 0) fetch(blocks);
      tail_ = std::exchange(held_, {});
      places_.resize(blocks);
    }
    tail_.resize(size % block);
  }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] Number operator[](std::size_t i) const {
    const auto number = i / block;
    if (number == places_.size()) return tail_[i % block];
    if (number != held_number_ || held_.empty()) fetch(number);
    return held_[i % block];
  }
  [[nodiscard]] Number front() const { return (*this)[0]; }
  [[nodiscard]] Number back() const { return tail_.back(); }
  [[nodiscard]] const_iterator begin() const { return {this, 0}; }
  [[nodiscard]] const_iterator end() const { return {this, size()}; }
  friend bool operator==(const Series& a, const Series& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }
  friend bool operator==(const std::vector<Number>& a, const Series& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
  }

 private:
  void put_away() {
    places_.push_back(spool_->write(tail_.data(), block * sizeof(Number)));
    tail_.clear();
  }
  void fetch(std::size_t number) const {
    held_.resize(block);
    spool_->read(places_[number], held_.data(), block * sizeof(Number));
    held_number_ = number;
  }

  std::shared_ptr<Spool> spool_;
  std::vector<std::int64_t> places_;  ///< of the full blocks in the spool
  std::vector<Number> tail_;          ///< what comes after them
  mutable std::vector<Number> held_;  ///< the block read last
  mutable std::size_t held_number_ = 0;
};

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
  /// A log: StateArchive::log.
  [[nodiscard]] std::size_t grown() const { return size(); }
  void shorten(std::size_t size);
  void entries(StateArchive& archive, std::size_t from, std::size_t to);
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
  /// Rows and events: logs.
  void visit(StateArchive& archive);
  // A log of its rows.
  [[nodiscard]] std::size_t grown() const { return times_.size(); }
  void shorten(std::size_t rows);
  void entries(StateArchive& archive, std::size_t from, std::size_t to);

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

using sim::seconds_text;
/// A number to print: 0 where it is nothing but rounding noise, closer to 0 than 1e-9 in its unit.
double without_noise(double number);
/// `name=number unit; ...` or the event's text, as events.csv and the report show it.
std::string values_text(const RecordedEvent& event, int digits = 9);

/// Looks at a run while it goes on and changes nothing of it. The watch has been updated before each call.
class Observer {
 public:
  virtual ~Observer() = default;
  /// A record instant.
  virtual void sample(Time) {}
  /// Time zero and every physics step, before the rest, of who asked for it; nothing has been updated.
  virtual void stepped(Time) {}
  virtual void happened(const RecordedEvent&) {}
  /// What it has come to, if it keeps anything.
  virtual void visit(StateArchive&) {}
  /// The run has come to its end. May throw std::runtime_error when something cannot be written.
  virtual void finish() {}

 protected:
  Observer() = default;
  Observer(const Observer&) = default;
  Observer& operator=(const Observer&) = default;
};

}  // namespace drycut::sim::record
