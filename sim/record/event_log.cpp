#include "sim/record/recording.hpp"

#include <algorithm>
#include <tuple>

#include "base/state_archive.hpp"

namespace drycut::sim::record {

const RecordedEvent::Value* RecordedEvent::find(const std::string& name) const {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const Value& value) { return value.name == name; });
  return found == values.end() ? nullptr : &*found;
}

bool EventLog::Kind::operator<(const Kind& other) const {
  return std::tie(source, event, values, severity) <
         std::tie(other.source, other.event, other.values, other.severity);
}

void EventLog::push_back(const RecordedEvent& event) {
  Kind kind{event.source, event.event, {}, event.severity};
  for (const auto& value : event.values) kind.values.emplace_back(value.name, value.unit);
  entries_.push_back({event.time, event.within, &*kinds_.insert(std::move(kind)).first,
                      &*texts_.insert(event.text).first, numbers_.size()});
  for (const auto& value : event.values) numbers_.push_back(value.number);
}

void EventLog::clear() {
  entries_.clear();
  texts_.clear();
  numbers_.clear();
}

RecordedEvent EventLog::operator[](std::size_t i) const {
  const auto& entry = entries_[i];
  RecordedEvent event{entry.time, entry.within, entry.kind->source,  entry.kind->event,
                      {},         *entry.text,  entry.kind->severity};
  auto number = entry.numbers;
  for (const auto& [name, unit] : entry.kind->values)
    event.values.push_back({name, numbers_[number++], unit});
  return event;
}

void EventLog::shorten(std::size_t size) {
  if (size >= entries_.size()) return;
  numbers_.resize(entries_[size].numbers);
  entries_.resize(size);
}

void EventLog::entries(StateArchive& archive, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    RecordedEvent event;
    if (!archive.restores()) event = (*this)[i];
    STATE(archive, event.time, event.within, event.source, event.event, event.text, event.severity);
    archive.list("values", event.values,
                 [&](RecordedEvent::Value& value) { STATE(archive, value.name, value.number, value.unit); });
    if (archive.restores()) push_back(event);
  }
}

}  // namespace drycut::sim::record
