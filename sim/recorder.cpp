#include "sim/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/file.hpp"

namespace drycut::sim {

const RecordedEvent::Value* RecordedEvent::find(const std::string& name) const {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const Value& value) { return value.name == name; });
  return found == values.end() ? nullptr : &*found;
}

Recording Recording::restored(std::vector<Time> times, std::vector<Column> columns) {
  Recording recording;
  recording.times_ = std::move(times);
  recording.columns_ = std::move(columns);
  return recording;
}

bool Recording::add(Watch& watch, const std::string& name) {
  if (column(name) != nullptr) return true;
  const auto* slot = watch.slot(name);
  if (slot == nullptr) return false;
  columns_.push_back({name, watch.unit(name), slot, {}});
  return true;
}

void Recording::reserve(std::size_t rows) {
  times_.reserve(rows);
  for (auto& column : columns_) column.values.reserve(rows);
}

void Recording::sample(Time time) {
  times_.push_back(time);
  for (auto& column : columns_) column.values.push_back(*column.slot);
}

const Recording::Column* Recording::column(const std::string& name) const {
  const auto found = std::find_if(columns_.begin(), columns_.end(),
                                  [&](const Column& column) { return column.name == name; });
  return found == columns_.end() ? nullptr : &*found;
}

std::string seconds_text(Time time) {
  auto text = fmt::format("{}.{:09}", time / second, time % second);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text += '0';
  return text;
}

double without_noise(double number) { return std::abs(number) < 1e-9 ? 0.0 : number; }

std::string values_text(const RecordedEvent& event, int digits) {
  std::string text;
  for (const auto& value : event.values) {
    if (!text.empty()) text += "; ";
    text += fmt::format("{}={:.{}g}{}{}", value.name, without_noise(value.number), digits,
                        value.unit.empty() ? "" : " ", value.unit);
  }
  if (!event.text.empty()) text += (text.empty() ? "" : "; ") + event.text;
  return text;
}

namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

}  // namespace

void write_trace(const Recording& recording, const std::filesystem::path& file) {
  OutputFile out(file);
  fmt::memory_buffer line;
  auto end = std::back_inserter(line);
  fmt::format_to(end, "time [s]");
  for (const auto& column : recording.columns()) {
    fmt::format_to(end, ",{}",
                   quoted(fmt::format("{} [{}]", column.name, column.unit.empty() ? "-" : column.unit)));
  }
  fmt::format_to(end, "\n");
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    fmt::format_to(end, "{}", seconds_text(recording.times()[row]));
    for (const auto& column : recording.columns()) fmt::format_to(end, ",{}", column.values[row]);
    fmt::format_to(end, "\n");
    if (line.size() > 1 << 16) {
      out.write({line.data(), line.size()});
      line.clear();
    }
  }
  out.write({line.data(), line.size()});
  out.finish();
}

void write_events(const Recording& recording, const std::filesystem::path& file) {
  OutputFile out(file);
  out.write("time [s],source,event,values\n");
  for (const auto& event : recording.events()) {
    out.write(fmt::format("{:.9f},{},{},{}\n", event.at_seconds(), quoted(event.source), quoted(event.event),
                          quoted(values_text(event))));
  }
  out.finish();
}

}  // namespace drycut::sim
