#include "sim/loop/drive_judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/units.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::size_t cycles_in_a_row = 10;
constexpr std::size_t fewest_in_a_row = 3;  // that are judged where the order changes before ten
constexpr std::size_t most_points = 20000;
constexpr double good = 0.9;             // of a rating; above, a figure warns
constexpr double most_saturated = 0.01;  // of the time of cycles
constexpr double unsteady = 0.2;         // a cycle that differs by more from the one before does not count
constexpr double percent = 100;

// The share of the speed at which a figure would be at 90 % of its rating. `constant`: the share of the
// square of the torque that does not go with the speed.
double advised_for(const DriveFigure& figure, double constant) {
  const double wanted = good / figure.share;
  const auto torque = [&](double square) {
    return constant < 1 ? std::sqrt(std::max(0.0, (square - constant) / (1 - constant))) : 0;
  };
  switch (figure.goes) {
    case DriveFigure::Goes::as_the_speed:
      return wanted;
    case DriveFigure::Goes::as_the_torque:
      return torque(wanted * wanted);
    case DriveFigure::Goes::as_its_square:
      return torque(wanted);
    case DriveFigure::Goes::as_the_braking:
      return wanted;
    case DriveFigure::Goes::not_with_it:
      break;
  }
  return 1;
}

constexpr std::array<std::string_view, 3> trip_events = {"overload", "bus_overvoltage", "bus_undervoltage"};

}  // namespace

void Thinned::add(double x, double y) {
  if (seen_++ % stride_ != 0) return;
  points_.emplace_back(x, y);
  if (points_.size() < most_points) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  stride_ *= 2;
}

bool DriveVerdict::holds() const { return trips.empty() && tightest().share <= 1; }

const DriveFigure& DriveVerdict::tightest() const {
  return *std::max_element(figures.begin(), figures.end(), [](const auto& a, const auto& b) {
    return (a.judged ? a.share : 0) < (b.judged ? b.share : 0);
  });
}

DriveJudge::DriveJudge(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants)
    : judged_(scenario.drives.judge), cycle_(scenario.drives.cycle) {
  next_ = cycle_;
  for (const auto& [name, plant] : plants)
    for (const auto& drive : plant->drives()) {
      drives_.push_back({name, drive.name, drive.stage, drive.load_inertia, drive.alike});
      if (cycle_ > 0) begin_cycles(drives_.back());
    }
}

void DriveJudge::begin_cycles(Drive& drive) {
  drive.begun = true;
  drive.ends = {drive.stage->totals()};
  drive.stage->forget_peaks();
}

void DriveJudge::end_cycle(Drive& drive, bool any) {
  const auto& now = drive.stage->totals();
  const auto& last = drive.ends.back();
  const double cycle = now.time - last.time;
  if (cycle <= 0) return;
  const double before = std::exchange(drive.last, cycle);
  if (!any && std::abs(cycle - before) > unsteady * before) {
    if (drive.ends.size() > fewest_in_a_row && drive.ends.size() <= cycles_in_a_row)
      judge(drive, drive.ends.front(), last);
    drive.ends = {now};
    return;
  }
  drive.cycle_points.add((now.travel - last.travel) / cycle,
                         std::sqrt((now.torque_squared - last.torque_squared) / cycle));
  ++drive.cycles;
  drive.worst.saturated_once = std::max(drive.worst.saturated_once, (now.saturated - last.saturated) / cycle);
  drive.energy += now.from_mains - last.from_mains;
  drive.ends.push_back(now);
  if (drive.ends.size() > cycles_in_a_row + 1) drive.ends.pop_front();
  if (drive.ends.size() > cycles_in_a_row) judge(drive, drive.ends.front(), now);
}

void DriveJudge::judge(Drive& drive, const plants::DriveTotals& from, const plants::DriveTotals& until) {
  auto& worst = drive.worst;
  drive.judged = true;
  const double time = until.time - from.time;
  const double torque = std::sqrt((until.torque_squared - from.torque_squared) / time);
  const double speed = (until.travel - from.travel) / time;
  const double share = torque / drive.stage->ratings().continuous(speed);
  if (share >= worst.share) {
    worst.torque = torque;
    worst.speed = speed;
    worst.share = share;
    // What accelerates and brakes again does no work over a cycle.
    const double travel = until.travel - from.travel;
    const double friction = travel > 0 ? (until.work - from.work) / travel : 0;
    worst.constant = torque > 0 ? std::min(1.0, friction * friction / (torque * torque)) : 0;
  }
  const double current_squared = (until.current_squared - from.current_squared) / time;
  if (current_squared >= worst.current_squared) {
    worst.current_squared = current_squared;
    worst.rotor_loss = (until.rotor_loss - from.rotor_loss) / time;
  }
  worst.fed_squared = std::max(worst.fed_squared, (until.fed_squared - from.fed_squared) / time);
  worst.resistor = std::max(worst.resistor, (until.in_resistor - from.in_resistor) / time);
  worst.saturated = std::max(worst.saturated, (until.saturated - from.saturated) / time);
}

void DriveJudge::sample(Time now) {
  const bool over = cycle_ > 0 && now >= next_;
  while (cycle_ > 0 && now >= next_) next_ += cycle_;
  for (auto& drive : drives_) {
    if (over) end_cycle(drive, true);
    drive.points.add(drive.stage->speed(), drive.stage->torque());
  }
}

void DriveJudge::happened(const RecordedEvent& event) {
  for (auto& drive : drives_) {
    if (drive.plant != event.source) continue;
    if (std::find(trip_events.begin(), trip_events.end(), event.event) != trip_events.end())
      drive.trips.push_back(fmt::format("{} at {:.3f} s", event.event, event.at_seconds()));
    if (cycle_ > 0 || event.event != "cut") continue;
    if (drive.begun)
      end_cycle(drive, false);
    else
      begin_cycles(drive);
  }
}

double DriveJudge::cycle_of(const std::string& plant, Time now) const {
  if (cycle_ > 0) return seconds(cycle_);
  for (const auto& drive : drives_)
    if (drive.plant == plant && drive.last > 0) return drive.last;
  return seconds(now);
}

DriveVerdict DriveJudge::verdict(Drive drive) const {
  const auto& stage = *drive.stage;
  DriveVerdict verdict;
  verdict.drive = drive.plant + "." + drive.name;
  verdict.ratings = stage.ratings();
  const bool whole = drive.cycles == 0;
  if (whole && stage.totals().time > 0)
    judge(drive, {}, stage.totals());
  else if (!drive.judged && drive.ends.size() > 1)
    judge(drive, drive.ends.front(), drive.ends.back());  // fewer than ten are judged as they are
  verdict.cycles = whole        ? "the whole run: no cycle from cut to cut, none named (drives.cycle)"
                   : cycle_ > 0 ? fmt::format("{} cycles of {} s", drive.cycles, seconds_text(cycle_))
                                : fmt::format("{} cycles from cut to cut", drive.cycles);
  verdict.alike = drive.alike;
  if (drive.alike > 1) verdict.cycles += fmt::format(", each of {} drives", drive.alike);
  const auto& worst = drive.worst;
  const auto& peaks = stage.peaks();
  const auto& ratings = verdict.ratings;
  using Goes = DriveFigure::Goes;
  const auto add = [&](std::string name, double value, double rating, std::string unit, Goes goes,
                       bool judged = true) {
    const double share = rating > 0 ? value / rating : value > 0 ? 2 : 0;
    verdict.figures.push_back({std::move(name), value, rating, std::move(unit), share, goes, judged});
  };
  const auto over_ambient = [](double kelvin) { return kelvin - plants::MotorHeat::ambient; };
  const double winding_limit = over_ambient(stage.temperature_limit());
  add("rms torque", worst.torque, ratings.continuous(worst.speed), "N m", Goes::as_the_torque, !whole);
  add("peak torque", peaks.torque, peaks.share > 0 ? peaks.torque / peaks.share : ratings.peak_torque, "N m",
      Goes::as_the_torque);
  add("largest speed", peaks.speed * units::rpm, ratings.max_speed * units::rpm, "rpm", Goes::as_the_speed);
  const double current = std::sqrt(worst.current_squared);
  add("rms current, for the winding", current, std::sqrt(stage.current_squared_for_ever(worst.rotor_loss)),
      "A", Goes::as_the_torque, !whole);
  const double steady = stage.steady_temperature(worst.current_squared, worst.rotor_loss);
  if (std::isfinite(steady))
    add("winding over 40 degC, for ever", over_ambient(steady), winding_limit, "K", Goes::not_with_it, false);
  add("winding over 40 degC, so far", over_ambient(peaks.winding), winding_limit, "K", Goes::as_its_square);
  if (const auto& amplifier = stage.amplifier()) {
    add("rms current, for the amplifier", std::sqrt(worst.fed_squared), amplifier->current, "A",
        Goes::as_the_torque, !whole);
    add("amplifier's I2t, so far", peaks.i2t * percent, percent, "%", Goes::as_its_square);
  }
  if (const auto& link = stage.link()) {
    const double mains = std::sqrt(2.0) * link->data().voltage;
    add("bus voltage over the mains'", std::max(0.0, peaks.voltage - mains),
        (link->data().overvoltage - 1) * mains, "V", Goes::not_with_it);
    if (worst.resistor > 0)
      add("brake resistor", worst.resistor, link->data().resistor_power, "W", Goes::as_the_braking, !whole);
  }
  if (worst.saturated > 0)
    add("time at the torque limit", worst.saturated * percent, most_saturated * percent, "%",
        Goes::not_with_it, !whole);
  if (worst.saturated_once > 0)
    add("time at the torque limit, worst cycle", worst.saturated_once * percent, percent, "%",
        Goes::not_with_it, false);
  verdict.inertia_ratio = drive.load_inertia / ratings.rotor_inertia;
  verdict.energy = whole ? stage.totals().from_mains : drive.energy / drive.cycles;
  verdict.trips = drive.trips;
  for (const auto& figure : verdict.figures)
    if (figure.judged && figure.share > good)
      verdict.advised = std::min(verdict.advised, advised_for(figure, worst.constant));
  verdict.cycle_points = drive.cycle_points.points();
  verdict.points = drive.points.points();
  return verdict;
}

std::vector<DriveVerdict> DriveJudge::verdicts() const {
  std::vector<DriveVerdict> verdicts;
  verdicts.reserve(drives_.size());
  for (const auto& drive : drives_) verdicts.push_back(verdict(drive));
  return verdicts;
}

std::string text_of(const DriveVerdict& verdict) {
  const auto& figure = verdict.tightest();
  auto text = fmt::format("{}{}: {}{} {:.4g} of {:.4g} {} ({:.0f} %)", verdict.drive,
                          verdict.alike > 1 ? fmt::format(", each of {}", verdict.alike) : "",
                          verdict.trips.empty() ? "" : fmt::format("{}; ", fmt::join(verdict.trips, ", ")),
                          figure.name, figure.value, figure.rating, figure.unit, figure.share * percent);
  std::vector<std::string> others;
  for (const auto& other : verdict.figures)
    if (&other != &figure && other.judged && other.share > 1)
      others.push_back(fmt::format("{} {:.0f} %", other.name, other.share * percent));
  if (!others.empty()) text += fmt::format(", {}", fmt::join(others, ", "));
  if (!verdict.holds() && verdict.advised < 1)
    text += fmt::format("; within 90 % at {:.0f} % of this speed, by a cautious estimate",
                        std::floor(verdict.advised * percent));
  return text;
}

std::vector<CheckResult> DriveJudge::results(const std::vector<DriveVerdict>& verdicts) const {
  if (!judged_ || drives_.empty()) return {};
  CheckResult result;
  result.name = "drive within its ratings";
  result.expectation =
      "torque, speed, current, heat, bus voltage and brake resistor of every drive within their ratings, "
      "over "
      "the worst ten cycles in a row as if they went on for ever; no trip";
  result.passed = true;
  std::vector<std::string> details;
  double largest = 0;
  for (const auto& verdict : verdicts) {
    result.passed = result.passed && verdict.holds();
    largest = std::max(largest, verdict.tightest().share);
    details.push_back(text_of(verdict));
  }
  result.margin = (1 - largest) * percent;
  result.used = largest;
  result.unit = "%";
  result.detail = fmt::format("{}", fmt::join(details, " | "));
  return {result};
}

}  // namespace drycut::sim::loop
