#include "sim/record/recording.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/state_archive.hpp"

namespace drycut::sim::record {

Recording::Column& Recording::add(std::string name, std::string unit) {
  index_.emplace(name, columns_.size());
  return columns_.emplace_back(Column{std::move(name), std::move(unit), nullptr, Series<double>(spool_)});
}

void Recording::sample(Time time) {
  if (!kept_) return;
  // The time last: a row for which there is no room is none.
  for (auto& column : columns_) column.values.push_back(*column.slot);
  times_.push_back(time);
}

void Recording::append(Time time, const std::vector<double>& row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].values.push_back(row[i]);
  times_.push_back(time);
}

const Recording::Column* Recording::column(const std::string& name) const {
  const auto found = index_.find(name);
  return found == index_.end() ? nullptr : &columns_[found->second];
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

void Recording::visit(StateArchive& archive) {
  archive.log("rows", *this);
  archive.log("events", events_);
}

void Recording::shorten(std::size_t rows) {
  times_.shorten(rows);
  for (auto& column : columns_) column.values.shorten(rows);
}

void Recording::entries(StateArchive& archive, std::size_t from, std::size_t to) {
  std::vector<double> row(columns_.size());
  for (std::size_t i = from; i < to; ++i) {
    Time time = 0;
    if (!archive.restores()) {
      time = times_[i];
      std::ranges::transform(columns_, row.begin(), [i](const auto& column) { return column.values[i]; });
    }
    STATE(archive, time, row);
    if (row.size() != columns_.size()) throw BadState("rows of other channels");
    if (archive.restores()) append(time, row);
  }
}

}  // namespace drycut::sim::record
