#include "sim/report/torque.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "plants/motor_load.hpp"
#include "plants/power_stage.hpp"
#include "sim/cams/study.hpp"
#include "sim/loop/played_cams.hpp"

namespace drycut::sim::report {

namespace {

using Sample = plants::TellsMotorLoad::Sample;

/// What was kept of a drive, with the time of it.
struct KeptDrive {
  std::string plant;
  std::string name;    ///< "knife.servo"
  double inertia = 0;  ///< of all that turns, seen at the motor [kg m2]
  const std::vector<Sample>* samples = nullptr;
  Time begin = 0;   ///< end of the step of the first sample
  Time period = 0;  ///< of the steps

  [[nodiscard]] std::size_t count() const { return samples->size(); }
  [[nodiscard]] Time end() const { return begin + static_cast<Time>(count() - 1) * period; }
};

std::vector<KeptDrive> kept_drives(const scenario::Scenario& scenario, const loop::Simulation& simulation) {
  std::vector<KeptDrive> kept;
  const Time step = scenario.scene.step;
  for (const auto& [name, plant] : simulation.plants()) {
    const auto* const tells = dynamic_cast<const plants::TellsMotorLoad*>(plant);
    if (tells == nullptr || tells->motor_loads() == nullptr || tells->motor_loads()->samples.size() < 2)
      continue;
    const auto drives = plant->drives();
    if (drives.empty()) continue;
    const auto& drive = drives.front();
    kept.push_back({name, name + "." + drive.name, drive.stage->ratings().rotor_inertia + drive.load_inertia,
                    &tells->motor_loads()->samples,
                    static_cast<Time>(tells->motor_loads()->left_out + 1) * step, step});
  }
  return kept;
}

/// The stretch of samples that is looked at: cycle k goes from bounds[k] to bounds[k + 1].
struct SplitCycles {
  std::vector<std::size_t> bounds;
  bool are_cycles = false;  ///< else all that was kept, of which nothing is known to come back
  [[nodiscard]] std::size_t count() const { return bounds.size() - 1; }
};

/// Of the bounds, which ascend, the last cycles that are alike.
SplitCycles last_alike(const std::vector<std::size_t>& bounds, std::size_t samples) {
  constexpr std::size_t most_split_cycles = 10;
  constexpr double same_length = 0.01;
  SplitCycles cycles;
  if (bounds.size() < 2) return {{0, samples}, false};
  const auto last = static_cast<double>(bounds.back() - bounds[bounds.size() - 2]);
  auto first = bounds.size() - 2;
  while (first > 0 && bounds.size() - 1 - first < most_split_cycles &&
         std::abs(static_cast<double>(bounds[first] - bounds[first - 1]) - last) <= same_length * last)
    --first;
  cycles.bounds.assign(bounds.begin() + static_cast<std::ptrdiff_t>(first), bounds.end());
  cycles.are_cycles = true;
  return cycles;
}

SplitCycles cycles_of_drive(const scenario::Scenario& scenario, const loop::Simulation& simulation,
                            const record::DriveVerdict& verdict, const KeptDrive& drive) {
  const double step = seconds(drive.period);
  std::vector<std::size_t> bounds;
  const auto place = [&](double time) {
    const double steps = std::round((time - seconds(drive.begin)) / step);
    return static_cast<std::size_t>(std::clamp(steps, 0.0, static_cast<double>(drive.count())));
  };
  if (verdict.cycle_points.empty()) {
    const auto& [from, until] = verdict.last_cycles.at(0);
    return {{place(from), place(until)}, false};
  }
  if (scenario.drives.cycle > 0) {
    // Those that follow each other to the last, as far as all of them was kept.
    const auto& cycles = verdict.last_cycles;
    bounds.push_back(place(cycles.back().second));
    for (auto i = cycles.size(); i-- > 0 && cycles[i].first >= seconds(drive.begin);) {
      if (i + 1 < cycles.size() && cycles[i].second < cycles[i + 1].first - 2 * step) break;
      bounds.push_back(place(cycles[i].first));
    }
    std::reverse(bounds.begin(), bounds.end());
  } else {
    for (const auto& event : simulation.recording().events()) {
      if (event.source != drive.plant || event.event != plants::cut_event) continue;
      const double index = std::round((event.at_seconds() - seconds(drive.begin)) / step);
      if (index >= 0 && index <= static_cast<double>(drive.count()) &&
          (bounds.empty() || index > static_cast<double>(bounds.back())))
        bounds.push_back(static_cast<std::size_t>(index));
    }
  }
  return last_alike(bounds, drive.count());
}

/// A played cam as the motor's motion.
struct CamOfMotor {
  const loop::PlayedCam* cam = nullptr;
  double scale = 0;  ///< turn of the motor for a unit of the table [rad]
  double misfit = std::numeric_limits<double>::infinity();  ///< share of the motion that it does not explain
};

/// Finds out whether a motor moves as the measured slave of a cam does, and by which ratio: a straight line
/// through both positions, with a constant of its own for each time that the cam was entered. What the device
/// knows of the slave is up to a sampling old.
class CamFitter {
 public:
  CamFitter(const KeptDrive& drive, const SplitCycles& cycles)
      : drive_(drive), from_(cycles.bounds.front()), until_(cycles.bounds.back()) {
    const double step = seconds(drive.period);
    angle_.reserve(drive.count());
    double angle = 0;
    for (const auto& sample : *drive.samples)
      angle_.push_back(angle += static_cast<double>(sample.speed) * step);
  }

  [[nodiscard]] CamOfMotor fit(const loop::PlayedCam& cam, Time record) {
    collect(cam);
    CamOfMotor best;
    constexpr std::size_t fewest = 20;
    if (points_.size() < fewest) return best;
    const auto most_lag = static_cast<std::size_t>(2 * record / drive_.period);
    const std::size_t lag_step = std::max<std::size_t>(1, most_lag / 40);
    for (std::size_t lag = 0; lag <= most_lag; lag += lag_step) {
      const auto fitted = with_lag(lag);
      if (fitted.misfit < best.misfit) best = fitted;
    }
    best.cam = &cam;
    return best;
  }

 private:
  struct Point {
    std::size_t index;  ///< of the sample
    std::size_t entry;  ///< since which it is on the cam
    double slave;
  };

  void collect(const loop::PlayedCam& cam) {
    points_.clear();
    std::size_t entry = 0;
    double before = 0;
    double way = 0;
    for (const auto& sample : cam.samples) {
      if (sample.begins) ++entry;
      if (sample.time <= drive_.begin) continue;
      const auto index = static_cast<std::size_t>((sample.time - drive_.begin) / drive_.period);
      if (index < from_ || index >= until_) continue;
      const double measured = sample.set - (std::isnan(sample.behind) ? 0 : sample.behind);
      const bool goes_on = !points_.empty() && points_.back().entry == entry;
      double moved = goes_on ? measured - before : 0;
      if (sample.turn > 0) moved -= sample.turn * std::round(moved / sample.turn);
      way = goes_on ? way + moved : measured;
      before = measured;
      points_.push_back({index, entry, way});
    }
  }

  [[nodiscard]] CamOfMotor with_lag(std::size_t lag) const {
    double covariance = 0;
    double of_slave = 0;
    double of_motor = 0;
    for (std::size_t first = 0; first < points_.size();) {
      std::size_t last = first;
      while (last + 1 < points_.size() && points_[last + 1].entry == points_[first].entry) ++last;
      add_entry(first, last, lag, covariance, of_slave, of_motor);
      first = last + 1;
    }
    CamOfMotor fitted;
    if (of_slave <= 0 || of_motor <= 0) return fitted;
    fitted.scale = covariance / of_slave;
    fitted.misfit = 1 - covariance * covariance / (of_slave * of_motor);
    return fitted;
  }

  /// Sums of squares about the straight line in time: two axes that merely both run on are no pair.
  void add_entry(std::size_t first, std::size_t last, std::size_t lag, double& covariance, double& of_slave,
                 double& of_motor) const {
    const auto count = static_cast<double>(last - first + 1);
    if (count < 3) return;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    const auto row = [&](std::size_t i) {
      const auto& point = points_[i];
      return Eigen::Vector3d(static_cast<double>(point.index), point.slave,
                             angle_[point.index > lag ? point.index - lag : 0]);
    };
    for (std::size_t i = first; i <= last; ++i) mean += row(i) / count;
    Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
    for (std::size_t i = first; i <= last; ++i) {
      const Eigen::Vector3d about = row(i) - mean;
      sums += about * about.transpose();
    }
    const auto less_line = [&](int a, int b) { return sums(a, b) - sums(0, a) * sums(0, b) / sums(0, 0); };
    covariance += less_line(1, 2);
    of_slave += less_line(1, 1);
    of_motor += less_line(2, 2);
  }

  const KeptDrive& drive_;
  std::size_t from_;
  std::size_t until_;
  std::vector<double> angle_;
  std::vector<Point> points_;
};

/// The master about a sample: where it was, its speed and half its acceleration. It is counted in whole
/// steps, so that the parabola is that through the samples of 50 ms before and behind.
Eigen::Vector3d master_about(const std::vector<loop::PlayedCam::Sample>& samples, std::size_t at) {
  constexpr Time reach = 50 * millisecond;
  const auto here = samples[at].time;
  std::size_t first = at;
  std::size_t last = at;
  while (first > 0 && !samples[first].begins && here - samples[first - 1].time <= reach) --first;
  while (last + 1 < samples.size() && !samples[last + 1].begins && samples[last + 1].time - here <= reach)
    ++last;
  if (last - first < 4) return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double scale = seconds(reach);
  for (auto i = first; i <= last; ++i) {
    const double time = seconds(samples[i].time - here) / scale;
    const Eigen::Vector3d powers(1, time, time * time);
    matrix += powers * powers.transpose();
    right += powers * (samples[i].master - samples[at].master);
  }
  Eigen::Vector3d found = matrix.ldlt().solve(right);
  found[0] += samples[at].master;
  found[1] /= scale;
  found[2] /= scale * scale;
  return found;
}

/// Angular acceleration of the motor in every step of the cycles, if it were exactly on the cam [rad/s2]; not
/// a number where it is not on one.
std::vector<double> ideal_acceleration(const CamOfMotor& motor, const SplitCycles& cycles,
                                       const KeptDrive& drive) {
  const auto& samples = motor.cam->samples;
  cams::MasterRange range{samples.front().master, samples.front().master};
  for (const auto& sample : samples)
    range = {std::min(range.first, sample.master), std::max(range.last, sample.master)};
  const auto ideal = cams::ideal_cam(*motor.cam->table, range);
  const auto from = cycles.bounds.front();
  std::vector<double> found(cycles.bounds.back() - from, std::numeric_limits<double>::quiet_NaN());
  if (!ideal.runs() || !ideal.slave) return found;
  const double reach = 5e-4 * (ideal.cycles[1] - ideal.cycles[0]);  // of the differences
  const auto at = [&](std::size_t sample, double time) {
    const auto master = master_about(samples, sample);
    return [=, &ideal](double later) {
      const double t = time + later;
      const double place = master[0] + (master[1] + master[2] * t) * t;
      const double speed = master[1] + 2 * master[2] * t;
      const double before = ideal.slave(place - reach);
      const double here = ideal.slave(place);
      const double behind = ideal.slave(place + reach);
      return (behind - 2 * here + before) / (reach * reach) * speed * speed +
             (behind - before) / (2 * reach) * 2 * master[2];
    };
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    // The steps that are nearer to this sample than to its neighbours.
    const bool alone = i + 1 == samples.size() || samples[i + 1].begins;
    const Time until = alone ? samples[i].time : (samples[i].time + samples[i + 1].time) / 2;
    const Time since =
        i == 0 || samples[i].begins ? samples[i].time : (samples[i - 1].time + samples[i].time) / 2;
    const auto index = [&](Time time) { return (time - drive.begin) / drive.period; };
    const auto first = std::max<Time>(index(since) + 1, static_cast<Time>(from));
    const auto last = std::min<Time>(index(until), static_cast<Time>(cycles.bounds.back()) - 1);
    if (last < first) continue;
    const auto law = at(i, 0);
    for (auto k = first; k <= last; ++k)
      found[static_cast<std::size_t>(k) - from] =
          motor.scale * law(seconds(drive.begin + k * drive.period - samples[i].time));
  }
  return found;
}

/// What comes back in every cycle: the mean of all at equal shares of their length.
std::vector<double> repeating(const std::vector<double>& values, const SplitCycles& cycles) {
  const auto from = cycles.bounds.front();
  const auto length = cycles.bounds[1] - from;
  const auto place = [&](std::size_t cycle, std::size_t part) {
    const auto begin = cycles.bounds[cycle] - from;
    const auto own = cycles.bounds[cycle + 1] - cycles.bounds[cycle];
    return begin + std::min(own - 1, part * own / length);
  };
  std::vector<double> mean(length, 0);
  for (std::size_t part = 0; part < length; ++part)
    for (std::size_t cycle = 0; cycle < cycles.count(); ++cycle)
      mean[part] += values[place(cycle, part)] / static_cast<double>(cycles.count());
  std::vector<double> made(values.size());
  for (std::size_t cycle = 0; cycle < cycles.count(); ++cycle) {
    const auto begin = cycles.bounds[cycle] - from;
    const auto own = cycles.bounds[cycle + 1] - cycles.bounds[cycle];
    for (std::size_t i = 0; i < own; ++i) made[begin + i] = mean[std::min(length - 1, i * length / own)];
  }
  return made;
}

void measure(TorqueSplit::Part& part, const std::vector<double>& torque) {
  double squares = 0;
  double along = 0;
  double whole = 0;
  for (std::size_t i = 0; i < torque.size(); ++i) {
    squares += part.torque[i] * part.torque[i];
    along += part.torque[i] * torque[i];
    whole += torque[i] * torque[i];
    part.peak = std::max(part.peak, std::abs(part.torque[i]));
  }
  part.rms = std::sqrt(squares / static_cast<double>(torque.size()));
  part.share = whole > 0 ? along / whole : 0;
}

class DriveSplitter {
 public:
  DriveSplitter(const KeptDrive& drive, const SplitCycles& cycles)
      : drive_(drive), cycles_(cycles), from_(cycles.bounds.front()), count_(cycles.bounds.back() - from_) {}

  TorqueSplit run(const std::vector<double>& cam_acceleration) {
    split_.drive = drive_.name;
    split_.cycles = cycles_.are_cycles ? cycles_.count() : 0;
    split_.begin = seconds(drive_.begin + static_cast<Time>(from_) * drive_.period);
    split_.end = split_.begin + static_cast<double>(count_) * seconds(drive_.period);
    const auto accelerating = of(&Sample::acceleration);
    split_.torque = {"motor torque", "all of it", of(&Sample::torque)};
    measure(split_.torque, split_.torque.torque);
    const bool repeats = cycles_.are_cycles && cycles_.count() >= fewest_to_compare;
    split_.has_cam = !cam_acceleration.empty();
    auto motion = accelerating;
    if (split_.has_cam) {
      for (std::size_t i = 0; i < count_; ++i)
        if (!std::isnan(cam_acceleration[i])) motion[i] = drive_.inertia * cam_acceleration[i];
    } else if (repeats) {
      motion = repeating(accelerating, cycles_);
    }
    auto rest = split_.torque.torque;
    const auto less = [&](const std::vector<double>& part) {
      for (std::size_t i = 0; i < count_; ++i) rest[i] -= part[i];
    };
    less(motion);
    if (split_.has_cam)
      add("cam", "all inertia times the acceleration of the ideal cam", std::move(motion));
    else
      add("motion", "all inertia times its acceleration, as it was driven", std::move(motion));
    add_measured("friction", "of motor, gear and guides; brakes", &Sample::friction, less);
    add_measured("load", "cut, workpiece, clamps, end stops", &Sample::load, less);
    add_measured("gravity", "weight less counterbalance", &Sample::gravity, less);
    if (split_.has_cam && repeats) {
      auto regulator = repeating(rest, cycles_);
      less(regulator);
      add("regulator", "what it adds to the cam in every cycle: overshoot, lag, twist of the gear",
          std::move(regulator));
      add("counting noise", "what does not come back: steps of counting and sampling, disturbances",
          std::move(rest));
    } else {
      add(split_.has_cam ? "regulator and counting noise" : "counting noise",
          split_.has_cam ? "too few cycles to tell them apart" : "what does not come back", std::move(rest));
    }
    return std::move(split_);
  }

 private:
  static constexpr std::size_t fewest_to_compare = 3;

  [[nodiscard]] std::vector<double> of(float Sample::*member) const {
    std::vector<double> values(count_);
    for (std::size_t i = 0; i < count_; ++i) values[i] = (*drive_.samples)[from_ + i].*member;
    return values;
  }
  void add(std::string name, std::string meaning, std::vector<double> torque) {
    TorqueSplit::Part part{std::move(name), std::move(meaning), std::move(torque)};
    measure(part, split_.torque.torque);
    constexpr double nothing = 1e-5;  // of the torque: single precision
    if (part.rms > nothing * split_.torque.rms) split_.parts.push_back(std::move(part));
  }
  template <class Less>
  void add_measured(const char* name, const char* meaning, float Sample::*member, const Less& less) {
    auto values = of(member);
    less(values);
    add(name, meaning, std::move(values));
  }

  const KeptDrive& drive_;
  const SplitCycles& cycles_;
  std::size_t from_;
  std::size_t count_;
  TorqueSplit split_;
};

}  // namespace

void follow_torques(const scenario::Scenario& scenario, loop::Simulation& simulation) {
  // Two cycles hold a whole one, wherever they begin. A step takes 24 bytes.
  constexpr std::size_t usual = 100'000;
  constexpr std::size_t most = 2'000'000;
  const auto two_cycles = static_cast<std::size_t>(2 * scenario.drives.cycle / scenario.scene.step);
  const auto fewest = std::clamp(two_cycles, usual, most);
  for (const auto& [name, plant] : simulation.plants())
    if (auto* const tells = dynamic_cast<plants::TellsMotorLoad*>(plant)) tells->keep_motor_loads(fewest);
}

std::vector<TorqueSplit> torque_splits(const scenario::Scenario& scenario, const loop::Simulation& simulation,
                                       const std::vector<record::DriveVerdict>& verdicts) {
  std::vector<TorqueSplit> splits;
  const auto played =
      simulation.cams() == nullptr ? std::vector<loop::PlayedCam>() : simulation.cams()->played();
  for (const auto& drive : kept_drives(scenario, simulation)) {
    const auto verdict = std::ranges::find(verdicts, drive.name, &record::DriveVerdict::drive);
    if (verdict == verdicts.end()) continue;
    const auto cycles = cycles_of_drive(scenario, simulation, *verdict, drive);
    if (cycles.bounds.back() <= cycles.bounds.front()) continue;
    CamFitter fitter(drive, cycles);
    CamOfMotor best;
    for (const auto& cam : played) {
      if (cam.samples.empty() || cam.table == nullptr) continue;
      const auto fitted = fitter.fit(cam, scenario.record.every);
      if (fitted.misfit < best.misfit) best = fitted;
    }
    constexpr double most_misfit = 0.02;
    auto split = DriveSplitter(drive, cycles)
                     .run(best.misfit <= most_misfit ? ideal_acceleration(best, cycles, drive)
                                                     : std::vector<double>());
    if (split.torque.rms > 0) splits.push_back(std::move(split));
  }
  return splits;
}

renders::ReportTable torque_table(const TorqueSplit& split) {
  renders::ReportTable table{fmt::format("Torque of {} by cause", split.drive),
                             {"part", "rms [N m]", "peak [N m]", "share [%]"},
                             {},
                             false,
                             true};
  const auto add = [&](const TorqueSplit::Part& part) {
    table.rows.push_back(
        {{part.name + "\n" + part.meaning, fmt::format("{:.4g}", part.rms), fmt::format("{:.4g}", part.peak),
          fmt::format("{:.1f}", std::round(1000 * part.share) / 10 + 0.0)}});
  };
  for (const auto& part : split.parts) add(part);
  add(split.torque);
  table.rows.back().cells.front() += fmt::format(
      ", {}, {:.3f} to {:.3f} s",
      split.cycles > 0 ? fmt::format("last {}", counted(split.cycles, "cycle")) : "no cycle is known",
      split.begin, split.end);
  return table;
}

}  // namespace drycut::sim::report
