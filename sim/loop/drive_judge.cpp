#include "sim/loop/drive_judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include "base/state_archive.hpp"
#include "base/text.hpp"
#include "base/units.hpp"

namespace drycut::sim::loop {

namespace {

constexpr std::size_t cycles_in_a_row = 10;
constexpr std::size_t fewest_in_a_row = 3;  // that are judged where the order changes before ten
constexpr std::size_t most_points = 20000;
constexpr double good = 0.9;             // of a rating; above, a figure warns
constexpr double most_saturated = 0.01;  // of the time of cycles
constexpr double alike = 0.01;           // rms torques of a steady cycle and the one before
constexpr double turning = 1e-3;         // of the rated speed: slower a motor stands
constexpr double percent = 100;

// The share of the speed at which a figure would be at 90 % of its rating. `constant`: the share of the
// square of the torque that does not go with the speed.
double advised_for(const record::DriveFigure& figure, double constant) {
  const double wanted = good / figure.share;
  const auto torque = [&](double square) {
    return constant < 1 ? std::sqrt(std::max(0.0, (square - constant) / (1 - constant))) : 0;
  };
  switch (figure.goes) {
    case record::DriveFigure::Goes::as_the_speed:
      return wanted;
    case record::DriveFigure::Goes::as_the_torque:
      return torque(wanted * wanted);
    case record::DriveFigure::Goes::as_its_square:
      return torque(wanted);
    case record::DriveFigure::Goes::as_the_braking:
      return wanted;
    case record::DriveFigure::Goes::not_with_it:
      break;
  }
  return 1;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 4> trip_events = {
    {{"overload", "tripped by overload"},
     {"bus_overvoltage", "tripped by overvoltage"},
     {"bus_undervoltage", "tripped by undervoltage"},
     {"pulled_out", "pulled out"}}};

double rms_torque(const plants::DriveTotals& stretch) {
  return std::sqrt(stretch.torque_squared / stretch.time);
}

bool is_alike(double rms, double before) { return std::abs(rms - before) <= alike * before; }

template <typename Row>
plants::DriveTotals sum_of(Row from, Row until) {
  return std::accumulate(from, until, plants::DriveTotals{});
}

}  // namespace

void Thinned::add(double x, double y) {
  if (seen_++ % stride_ != 0) return;
  points_.emplace_back(x, y);
  if (points_.size() < most_points) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  stride_ *= 2;
}

DriveJudge::DriveJudge(const scenario::Scenario& scenario, const std::vector<NamedPlant>& plants)
    : judged_(scenario.drives.judge), cycle_(scenario.drives.cycle) {
  for (const auto& [name, plant] : plants)
    for (const auto& drive : plant->drives()) {
      drives_.push_back({name, drive.name, drive.stage, drive.load_inertia, drive.efficiency, drive.alike,
                         drive.cogging, drive.torque_ripple, DriveCycles(seconds(cycle_))});
      const auto monitor = fmt::format("{}.{}.mains_ok", name, drive.name);
      drives_.back().tells_mains =
          std::any_of(scenario.wiring.begin(), scenario.wiring.end(),
                      [&](const scenario::Wire& wire) { return wire.plug.text == monitor; });
    }
}

void DriveJudge::AtLimit::add(const AtLimit& more) {
  if (times == 0) first = more.first;
  times += more.times;
  seconds += more.seconds;
}

void DriveJudge::end_cycle(Drive& drive, DriveCycles::Ended ended) {
  if (ended == DriveCycles::Ended::nothing) return;
  const auto at_limit = std::exchange(drive.in_cycle, {});
  if (ended == DriveCycles::Ended::does_not_count) {
    drive.elsewhere.add(at_limit);
    if (drive.row.size() >= fewest_in_a_row && drive.row.size() < cycles_in_a_row) judge_row(drive);
    drive.row.clear();
    return;
  }
  const auto& cycle = drive.cycles.last();
  drive.last.emplace_back(drive.cycles.began(), drive.cycles.began() + cycle.time);
  if (drive.last.size() > cycles_in_a_row) drive.last.pop_front();
  const double rms = rms_torque(cycle);
  if (!drive.row.empty() && is_alike(rms, rms_torque(drive.row.back()))) {
    drive.steady = cycle;
    drive.heavier.reset();
  } else if (drive.steady && rms > rms_torque(drive.heavier.value_or(*drive.steady))) {
    drive.heavier = cycle;
  }
  drive.cycle_points.add(cycle.travel / cycle.time, rms);
  ++drive.counted;
  drive.energy += cycle.from_mains;
  drive.worst.saturated_once = std::max(drive.worst.saturated_once, cycle.saturated / cycle.time);
  drive.row.push_back(cycle);
  if (drive.row.size() > cycles_in_a_row) drive.row.pop_front();
  if (drive.row.size() < cycles_in_a_row) return;
  judge_row(drive);
  const auto middle = drive.row.begin() + cycles_in_a_row / 2;
  drive.even = drive.even || is_alike(rms_torque(sum_of(middle, drive.row.end())),
                                      rms_torque(sum_of(drive.row.begin(), middle)));
}

void DriveJudge::judge_row(Drive& drive) {
  drive.judged = std::max(drive.judged, drive.row.size());
  drive.worst.take(sum_of(drive.row.begin(), drive.row.end()), drive.stage->ratings());
}

// What was not judged in a row of ten. Returns of which window the means are; "" = of no cycles.
std::string DriveJudge::judge_rest(Drive& drive) {
  const auto& ratings = drive.stage->ratings();
  if (drive.judged == 0 && !drive.steady && drive.row.empty()) {
    if (const auto run = drive.stage->totals() - drive.cycles.before_motion(); run.time > 0)
      drive.worst.take(run, ratings);
    return "";
  }
  if (drive.judged < cycles_in_a_row && drive.steady) {
    drive.worst.take(*drive.steady, ratings);
    if (drive.heavier) drive.worst.take(*drive.heavier, ratings);
  }
  if (drive.judged > 0) return fmt::format("worst {} cycles in a row", drive.judged);
  if (drive.steady) return drive.heavier ? "heaviest cycle" : "steady cycle";
  judge_row(drive);
  return drive.row.size() == 1 ? "the one cycle" : fmt::format("mean of {} cycles", drive.row.size());
}

void DriveJudge::Worst::take(const plants::DriveTotals& stretch, const plants::DriveRatings& ratings) {
  const double rms = rms_torque(stretch);
  const double mean_speed = stretch.travel / stretch.time;
  if (const double of_all = rms / ratings.continuous(mean_speed); of_all >= share) {
    torque = rms;
    speed = mean_speed;
    share = of_all;
    // What accelerates and brakes again does no work over a cycle.
    const double friction = stretch.travel > 0 ? stretch.work / stretch.travel : 0;
    constant = rms > 0 ? std::min(1.0, friction * friction / (rms * rms)) : 0;
  }
  if (const double squared = stretch.current_squared / stretch.time; squared >= current_squared) {
    current_squared = squared;
    rotor_loss = stretch.rotor_loss / stretch.time;
  }
  fed_squared = std::max(fed_squared, stretch.fed_squared / stretch.time);
  resistor = std::max(resistor, stretch.in_resistor / stretch.time);
  saturated = std::max(saturated, stretch.saturated / stretch.time);
}

void DriveJudge::sample(Time /*now*/) {
  for (auto& drive : drives_) {
    const auto& stage = *drive.stage;
    const bool turns = std::abs(stage.speed()) > turning * stage.ratings().rated_speed;
    end_cycle(drive, drive.cycles.sample(stage.totals(), turns));
    drive.points.add(stage.speed(), stage.torque());
  }
}

void DriveJudge::happened(const record::RecordedEvent& event) {
  for (auto& drive : drives_) {
    if (drive.plant != event.source) continue;
    for (const auto& [name, words] : trip_events)
      if (event.event == name)
        drive.trips.push_back(fmt::format("{} at {:.3f} s", words, event.at_seconds()));
    const auto* begin = event.find("begin");
    const auto* end = event.find("end");
    if (event.event == "saturated" && begin != nullptr && end != nullptr)
      (drive.cycles.running() ? drive.in_cycle : drive.elsewhere)
          .add({1, end->number - begin->number, begin->number});
    if (event.event != plants::cut_event) continue;
    if (cycle_ == 0 && !drive.cycles.running()) drive.stage->forget_peaks();
    end_cycle(drive, drive.cycles.cut(drive.stage->totals()));
  }
}

double DriveJudge::cycle_of(const std::string& plant, Time now) const {
  if (cycle_ > 0) return seconds(cycle_);
  for (const auto& drive : drives_)
    if (drive.plant == plant && drive.cycles.last().time > 0) return drive.cycles.last().time;
  return seconds(now);
}

record::DriveVerdict DriveJudge::verdict(Drive drive) const {
  const auto& stage = *drive.stage;
  record::DriveVerdict verdict;
  verdict.drive = drive.plant + "." + drive.name;
  verdict.ratings = stage.ratings();
  auto means = judge_rest(drive);
  const bool whole = means.empty();
  if (whole) means = "from the first motion on";
  const std::string peaks_from =
      cycle_ == 0 && drive.cycles.running() ? "from the first cut on" : "whole run";
  verdict.cycles =
      whole        ? cycle_ > 0 ? "the whole run: it is shorter than drives.cycle"
                                : "the whole run: no cycle is known (drives.cycle)"
      : cycle_ > 0 ? fmt::format("{} of {} s", counted(drive.counted, "cycle"), record::seconds_text(cycle_))
                   : fmt::format("{} from cut to cut", counted(drive.counted, "cycle"));
  verdict.alike = drive.alike;
  if (drive.alike > 1) verdict.cycles += fmt::format(", each of {} drives", drive.alike);
  const auto& worst = drive.worst;
  const auto& peaks = stage.peaks();
  const auto& ratings = verdict.ratings;
  using Goes = record::DriveFigure::Goes;
  const auto add = [&](std::string name, double value, double rating, std::string unit, Goes goes,
                       bool judged, const std::string& window, std::string remark = {}) {
    const double share = rating > 0 ? value / rating : value > 0 ? 2 : 0;
    verdict.figures.push_back(
        {std::move(name), value, rating, std::move(unit), share, goes, judged, window, std::move(remark)});
  };
  const auto over_ambient = [](double kelvin) { return kelvin - plants::MotorHeat::ambient; };
  const double winding_limit = over_ambient(stage.temperature_limit());
  const std::string no_cycle = whole ? "no cycle is known" : "";
  const std::string works = ratings.works_at_limit ? "such a drive works at this limit" : "";
  add("rms torque", worst.torque, ratings.continuous(worst.speed), "N m", Goes::as_the_torque, !whole, means,
      no_cycle);
  add("peak torque", peaks.torque, peaks.share > 0 ? peaks.torque / peaks.share : ratings.peak_torque, "N m",
      Goes::as_the_torque, !ratings.works_at_limit, peaks_from, works);
  add("largest speed", peaks.speed * units::rpm, ratings.max_speed * units::rpm, "rpm", Goes::as_the_speed,
      true, peaks_from);
  const double current = std::sqrt(worst.current_squared);
  const double for_ever = stage.current_squared_for_ever(worst.rotor_loss);
  const double steady = stage.steady_temperature(worst.current_squared, worst.rotor_loss);
  // Where the rotor's losses alone are too much no current is left.
  if (for_ever > 0 || !std::isfinite(steady))
    add("rms current, for the winding", current, std::sqrt(for_ever), "A", Goes::as_the_torque, !whole, means,
        whole                  ? no_cycle
        : worst.rotor_loss > 0 ? "limit: what brings the winding to its temperature for ever, beside the "
                                 "rotor's loss of this duty"
                               : "limit: what brings the winding to its temperature for ever");
  if (std::isfinite(steady)) {
    const bool alone = for_ever <= 0 && !whole;
    add("winding temperature rise, continuous duty", over_ambient(steady), winding_limit, "K",
        Goes::not_with_it, alone, means,
        alone   ? ""
        : whole ? no_cycle
                : "its current is judged");
  }
  add("winding temperature rise, so far", over_ambient(peaks.winding), winding_limit, "K",
      Goes::as_its_square, true, peaks_from);
  if (const auto& amplifier = stage.amplifier()) {
    add("rms current, for the amplifier", std::sqrt(worst.fed_squared), amplifier->current, "A",
        Goes::as_the_torque, !whole, means, no_cycle);
    add("amplifier's I2t, so far", peaks.i2t * percent, percent, "%", Goes::as_its_square, true, peaks_from);
  }
  if (const auto& link = stage.link()) {
    const double mains = std::sqrt(2.0) * link->data().voltage;
    add("DC link above rectified mains", std::max(0.0, peaks.voltage - mains),
        (link->data().overvoltage - 1) * mains, "V", Goes::not_with_it, true, peaks_from);
    if (worst.resistor > 0)
      add("brake resistor", worst.resistor, link->data().resistor_power, "W", Goes::as_the_braking, !whole,
          means, no_cycle);
  }
  if (worst.saturated > 0)
    add("time at the torque limit", worst.saturated * percent,
        ratings.works_at_limit ? percent : most_saturated * percent, "%", Goes::not_with_it,
        !ratings.works_at_limit, means, works);
  if (worst.saturated_once > 0)
    add("time at the torque limit, worst cycle", worst.saturated_once * percent, percent, "%",
        Goes::not_with_it, false, verdict.cycles, "the mean is judged");
  verdict.inertia_ratio = drive.load_inertia / ratings.rotor_inertia;
  verdict.efficiency = drive.efficiency;
  verdict.cogging = drive.cogging;
  verdict.torque_ripple = drive.torque_ripple;
  verdict.energy = whole ? stage.totals().from_mains : drive.energy / drive.counted;
  verdict.energy_cycles = whole ? 0 : static_cast<int>(drive.counted);
  verdict.trips = drive.trips;
  for (const auto& figure : verdict.figures)
    if (figure.judged && figure.share > good)
      verdict.advised = std::min(verdict.advised, advised_for(figure, worst.constant));
  verdict.steady = (drive.steady && (!drive.heavier || drive.judged == cycles_in_a_row)) || drive.even;
  if (!whole) {
    drive.elsewhere.add(drive.in_cycle);
    if (const auto& [times, time, first] = drive.elsewhere; times > 0 && !ratings.works_at_limit)
      verdict.limit_elsewhere =
          fmt::format("{}, {:.3g} s in all, first at {:.3f} s",
                      times == 1 ? "once" : fmt::format("{} times", times), time, first);
  }
  if (judged_) remark(verdict, whole, drive.heavier.has_value());
  if (stage.without_mains() > 0 && !drive.tells_mains)
    verdict.warnings.push_back(
        fmt::format("{0}: a phase, or more than 15 % of the voltage, of its mains was missing for {1:.3g} s, "
                    "and nothing is wired to {0}.mains_ok",
                    verdict.drive, stage.without_mains()));
  verdict.last_cycles.assign(drive.last.begin(), drive.last.end());
  if (whole) verdict.last_cycles = {{drive.cycles.before_motion().time, stage.totals().time}};
  verdict.cycle_points = drive.cycle_points.points();
  verdict.points = drive.points.points();
  return verdict;
}

// What neither passes nor fails.
void DriveJudge::remark(record::DriveVerdict& verdict, bool whole, bool has_heavier) const {
  if (!whole) {
    if (!verdict.steady)
      verdict.notes.push_back(
          has_heavier
              ? fmt::format(
                    "{}: its heaviest cycle counts, of {}: none came after it with an rms torque within "
                    "1 % of its own",
                    verdict.drive, verdict.cycles)
              : fmt::format(
                    "{}: no steady cycle in {}: no rms torque is within 1 % of that of the cycle before; "
                    "let it run for longer",
                    verdict.drive, verdict.cycles));
    return;
  }
  auto text = fmt::format("{}: heat is not judged, for ", verdict.drive);
  text += cycle_ == 0 ? "no machine cycle is known; name its length, such as drives: {cycle: 2 s}"
                      : fmt::format(
                            "drives.cycle, {} s, is longer than the run from the first motion on; "
                            "take a longer scene.duration",
                            record::seconds_text(cycle_));
  bool over = false;
  const auto& means = verdict.figures.front().window;
  for (const auto& figure : verdict.figures) {
    if (figure.judged || figure.share <= 1 || figure.window != means) continue;
    over = true;
    text += fmt::format("; {} would be {:.0f} %", figure.name, figure.share * percent);
  }
  (over ? verdict.warnings : verdict.notes).push_back(std::move(text));
}

std::vector<record::DriveVerdict> DriveJudge::verdicts() const {
  std::vector<record::DriveVerdict> verdicts;
  verdicts.reserve(drives_.size());
  for (const auto& drive : drives_) verdicts.push_back(verdict(drive));
  return verdicts;
}

std::vector<record::CheckResult> DriveJudge::results(
    const std::vector<record::DriveVerdict>& verdicts) const {
  if (!judged_ || drives_.empty()) return {};
  record::CheckResult result;
  result.name = "drive within its ratings";
  std::vector<std::string> judged;  // of some drive
  for (const auto& verdict : verdicts)
    for (const auto& figure : verdict.figures)
      if (figure.judged && std::ranges::find(judged, figure.name) == judged.end())
        judged.push_back(figure.name);
  result.expectation = fmt::format("of every drive within its ratings: {}; no trip", fmt::join(judged, "; "));
  result.passed = true;
  std::vector<std::string> details;
  double largest = 0;
  for (const auto& verdict : verdicts) {
    result.passed = result.passed && verdict.holds();
    largest = std::max(largest, verdict.tightest().share);
    details.push_back(text_of(verdict));
  }
  if (result.passed || largest > 1) {  // a trip has no distance
    constexpr double digits = 1e6;     // a limit that is just reached leaves nothing
    result.margin = std::round((1 - largest) * percent * digits) / digits;
    result.used = largest;
    result.unit = "%";
  }
  result.detail = fmt::format("{}", fmt::join(details, " | "));
  return {result};
}

void Thinned::visit(StateArchive& archive, const std::string& name) {
  auto stride = stride_;
  auto seen = seen_;
  STATE(archive, stride, seen);
  if (archive.restores() && stride == 0) throw BadState("points without a stride");
  if (stride != stride_) points_.clear();
  stride_ = stride;
  archive.log(name, *this);
  seen_ = seen;
}

void Thinned::shorten(std::size_t seen) {
  points_.resize(std::min(points_.size(), (seen + stride_ - 1) / stride_));
}

// Point i is the one seen as number i * stride. In the journal lies what was kept then, of it what is kept
// now.
void Thinned::entries(StateArchive& archive, std::size_t from, std::size_t to) {
  auto stride = stride_;
  STATE(archive, stride);
  if (stride == 0) throw BadState("points without a stride");
  for (auto number = (from + stride - 1) / stride * stride; number < to; number += stride) {
    std::pair<double, double> point;
    if (!archive.restores() && number / stride < points_.size()) point = points_[number / stride];
    STATE(archive, point);
    if (archive.restores() && number % stride_ == 0) points_.push_back(point);
  }
}

void DriveJudge::visit(StateArchive& archive) {
  archive.each("drives_", drives_, [&](Drive& drive) {
    auto& worst = drive.worst;
    STATE(archive, drive.cycles, drive.counted, drive.energy, drive.last, drive.row, drive.judged,
          drive.steady, drive.heavier, drive.even, worst.torque, worst.speed, worst.share, worst.constant,
          worst.current_squared, worst.rotor_loss, worst.fed_squared, worst.resistor, worst.saturated,
          worst.saturated_once, drive.trips);
    const auto name = drive.plant + "." + drive.name;
    drive.cycle_points.visit(archive, name + " cycles");
    drive.points.visit(archive, name);
    for (auto* at : {&drive.in_cycle, &drive.elsewhere}) STATE(archive, at->times, at->seconds, at->first);
  });
}

}  // namespace drycut::sim::loop
