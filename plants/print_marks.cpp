#include "plants/print_marks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/state_archive.hpp"

namespace drycut::plants {

namespace {

constexpr double far_away = 1e6;

PositionSwitchData reader(const PrintMarkData& data) { return {0, data.width, data.hysteresis, data.delay}; }

}  // namespace

Parameters print_mark_parameters(PrintMarkData& data) {
  return {
      row("pitch", "mm", "nominal distance of two printed marks; 0: nothing is printed", data.pitch, 0, 1e5,
          "plain web"),
      row("offset", "mm", "shifts all marks against the direction of travel", data.offset, -1e5, 1e5,
          "the first mark is one pitch behind the start"),
      row("stretch", "", "true pitch = pitch * (1 + stretch)", data.stretch, -0.5, 0.5, "printed as nominal"),
      row("scatter", "mm", "standard deviation of each mark from its place", data.scatter, 0, 1000,
          "a perfect press"),
      row("width", "mm", "of a mark along the web", data.width, 0.1, 1000, "a usual register mark"),
      row("photocell", "mm", "place of the photocell before the cut", data.photocell, 0, 1e5,
          "between measuring wheel and pull rolls"),
      row("hysteresis", "mm", "the photocell lets go this far behind the edge of a mark", data.hysteresis, 0,
          100, "estimate"),
      row("delay", "ms", "delay of the photocell", data.delay, 0, 100, "estimate: a fast contrast sensor"),
  };
}

PrintMarks::PrintMarks(const PrintMarkData& data, Random noise)
    : data_(data), noise_(noise), photocell_(reader(data), 0, far_away) {
  if (!printed()) return;
  next_ = ExactSum(data.pitch + data.offset);
  while (places_.empty() || places_.back() <= data.photocell) print();
  photocell_ = PositionSwitch(reader(data), 0, std::abs(behind_mark(data.photocell)));
}

// Scatter as large as the pitch brings two marks out of order: each goes to its place.
void PrintMarks::print() {
  const double place = next_.value() + shift_ + data_.scatter * noise_.gaussian();
  places_.insert(std::upper_bound(places_.begin(), places_.end(), place), place);
  next_.add(data_.pitch * (1 + data_.stretch));
}

double PrintMarks::nearest(double place) const {
  const auto after = std::lower_bound(places_.begin(), places_.end(), place);
  if (after == places_.begin()) return *after;
  const double before = *std::prev(after);
  return after == places_.end() || place - before <= *after - place ? before : *after;
}

double PrintMarks::behind_mark(double place) const { return place - nearest(place); }

void PrintMarks::follow(double now, double h) {
  const double under = now + data_.photocell;
  while (places_.back() <= under) print();
  while (places_.size() > 2 && places_.front() < now - kept_behind_ - data_.pitch) places_.pop_front();
  photocell_.follow(std::abs(behind_mark(under)), h);
}

void PrintMarks::offer_faults(std::vector<Fault>& faults, const std::string& marks,
                              const std::string& photocell) {
  if (!printed()) return;
  faults.push_back(fault_value(marks, "shift", "mm", shift_,
                               "the marks after the next one lie this much further back: a splice",
                               {-1e5, 1e5, false}, 0.02));
  photocell_.offer_faults(faults, photocell);
}

void PrintMarks::visit(StateArchive& archive) { STATE(archive, noise_, places_, next_, shift_, photocell_); }

}  // namespace drycut::plants
