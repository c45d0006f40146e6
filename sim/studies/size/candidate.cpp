#include "sim/studies/size/candidate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double largest_inertia_ratio = 300;    // that servo.inertia_ratio takes
constexpr std::size_t most_candidates = 20'000;  // each is put together once before any runs
constexpr std::int64_t largest_gear_word = 16'777'216;
constexpr std::int64_t most_dividing = 2'000;  // lines of an encoder are looked for up to a multiple of that

/// A ratio of whole numbers, in lowest terms.
using Fraction = std::pair<std::int64_t, std::int64_t>;

Fraction reduced(Fraction fraction) {
  const auto divisor = std::gcd(fraction.first, fraction.second);
  return {fraction.first / divisor, fraction.second / divisor};
}

/// A decimal number, above 0, of at most 15 digits.
std::optional<Fraction> fraction_of(double value) {
  constexpr int most_digits = 12;
  Fraction fraction{0, 1};
  double shifted = value;
  for (int digits = 0; digits <= most_digits; ++digits, shifted *= 10, fraction.second *= 10) {
    if (std::abs(shifted - std::rint(shifted)) > 1e-9 || shifted > 1e15) continue;
    fraction.first = static_cast<std::int64_t>(std::rint(shifted));
    return reduced(fraction);
  }
  return {};
}

std::optional<Fraction> product(Fraction a, Fraction b) {
  const auto across = reduced({a.first, b.second});
  const auto other = reduced({b.first, a.second});
  Fraction made;
  if (__builtin_mul_overflow(across.first, other.first, &made.first) ||
      __builtin_mul_overflow(across.second, other.second, &made.second))
    return {};
  return made;
}

/// The plant and the machine of a scenario with these overrides.
struct MachineProbe {
  Problems problems;
  std::optional<record::DriveVerdict> drive = {};
  std::optional<double> ratio = {};
};
MachineProbe probe_machine(const PointQuestion& question, const SizedDrive& drive,
                           const std::vector<scenario::Override>& overrides) {
  auto point = read_point(question, overrides);
  MachineProbe made{std::move(point.problems)};
  if (!made.problems.empty() || !point.scenario.buildable) return made;
  made.ratio = number_in(plant_of(drive, point.scenario), "gear.ratio");
  loop::Simulation simulation(point.scenario, made.problems);
  if (!made.problems.empty()) return made;
  for (auto& verdict : simulation.outcome().drives)
    if (verdict.drive == drive.full_name()) made.drive = std::move(verdict);
  return made;
}

double si_of(const scenario::MotorModel& motor, std::string_view parameter) {
  const auto* const value = motor.find(parameter);
  const auto quantity = value == nullptr ? std::nullopt : scenario::parse_quantity(value->shown);
  return quantity ? scenario::to_si(quantity->number, quantity->unit) : 0;
}

class CandidateMaker {
 public:
  CandidateMaker(const SizeChoices& choices, const PointQuestion& question,
                 const scenario::Scenario& scenario)
      : choices_(choices),
        question_(question),
        plant_(plant_of(choices.drive, scenario)),
        supply_(choices.drive.supply()),
        gears_(choices.gears.empty() ? std::vector<std::string>{""} : choices.gears.front().values),
        resistors_(choices.resistors.empty() ? std::vector<BrakeResistor>(1) : choices.resistors) {
    counts_ = std::any_of(scenario.wiring.begin(), scenario.wiring.end(), [&](const auto& wire) {
      return wire.plug.text == choices.drive.plant + ".encoder";
    });
    if (choices.drive.is_servo()) set_up_ = present_set_up();
  }

  /// What to do about gears behind which the controller would count something else; "" if there are none.
  [[nodiscard]] std::string misfit_note() const {
    std::vector<std::string> gears;
    std::int64_t dividing = 1;
    if (choices_.gears.empty() || choices_.gear_is_tied) return "";
    const double present = *number_in(plant_, "gear.ratio");
    for (const auto& gear : gears_) {
      const double ratio = number_of_text(gear);
      const auto behind = fraction_of(ratio);
      const auto now = fraction_of(present);
      // Lines behind it: as many as now, times now over then.
      const auto share = behind && now ? product(*now, {behind->second, behind->first}) : std::nullopt;
      dividing = share ? std::lcm(dividing, share->second) : most_dividing + 1;
      dividing = std::min(dividing, most_dividing + 1);
      if (const auto lines = broken_lines(ratio / present))
        gears.push_back(fmt::format("{} ({:.6g} lines)", gear, *lines));
    }
    if (gears.empty()) return "";
    const double lines = *number_in(plant_, "encoder.lines");
    const double turn = lines * present;
    const auto encoder = choices_.drive.path("encoder");
    std::vector<std::string> ways;
    if (number_in(plant_, "encoder.on_drum") && turn == std::rint(turn))
      ways.push_back(
          fmt::format("count an encoder on the drum, {}: {{on_drum: true, lines: {:.0f}}}, whose one zero "
                      "pulse a turn may need another preset of homing",
                      encoder, turn));
    if (dividing <= most_dividing) {
      const double other =
          static_cast<double>(dividing) * std::max(1.0, std::rint(lines / static_cast<double>(dividing)));
      ways.push_back(fmt::format("take {}: {{lines: {:.0f}}} and {} counts a turn of the load in the program",
                                 encoder, other, number_text(4 * other * present)));
    }
    ways.push_back(
        fmt::format("tie the program's counts a turn, 4 x {:.0f} x gear, to a variable and give --gears "
                    "variables.gear=...; "
                    "where a turn has no whole number of counts, give ten turns and ten times the counts",
                    lines));
    return fmt::format(
        "gear {}: left out, for no whole number of encoder lines gives the controller its {} counts a turn "
        "of "
        "the load; {}",
        fmt::join(gears, ", "), number_text(4 * turn), fmt::join(ways, "; or "));
  }

  std::vector<Candidate> run() {
    std::vector<Candidate> candidates;
    candidates.reserve(choices_.motors.size() * gears_.size() * resistors_.size());
    for (const auto& motor : choices_.motors) {
      for (std::size_t i = 0; i < gears_.size(); ++i) {
        Candidate made = with_gear(motor, gears_[i], choices_.gear_kind(i));
        for (const auto& resistor : resistors_) candidates.push_back(with_resistor(made, resistor));
      }
    }
    return candidates;
  }

 private:
  /// Inertia that the speed loop is set for over the one that it turns, as the scenario has it.
  [[nodiscard]] double present_set_up() const {
    const auto present = probe_machine(question_, choices_.drive, {});
    const auto set = number_in(plant_, "servo.inertia_ratio");
    return present.drive && set ? (1 + *set) / (1 + present.drive->inertia_ratio) : 1;
  }

  Candidate with_gear(const scenario::MotorModel& motor, const std::string& gear,
                      const std::string& kind) const {
    const auto& drive = choices_.drive;
    Candidate made;
    made.motor = motor.name.text;
    made.values = motor.standing();
    made.rated_power = si_of(motor, "rated_power");
    if (made.rated_power <= 0) made.rated_power = si_of(motor, "rated_torque") * si_of(motor, "rated_speed");
    made.gear = gear;
    made.gear_kind = kind;
    made.overrides.push_back({drive.path(drive.kind + ".model"), motor.name.text});
    const auto present = number_in(plant_, "gear.ratio");
    made.ratio = present.value_or(0);
    if (!gear.empty()) {
      for (auto& override : overrides_of(choices_.gears, {gear}))
        made.overrides.push_back(std::move(override));
      if (!kind.empty()) made.overrides.push_back({drive.path("gear.type"), kind});
      if (!choices_.gear_is_tied) {
        made.ratio = number_of_text(gear);
        take_along(made, made.ratio / *present, *present);
      }
    }
    auto without = made.overrides;
    const auto inertia_ratio = drive.path("servo.inertia_ratio");
    if (drive.is_servo()) without.push_back({inertia_ratio, "0"});
    const auto machine = probe_machine(question_, drive, without);
    if (machine.ratio) made.ratio = *machine.ratio;
    if (!machine.drive) {
      if (made.unfit.empty() && !machine.problems.empty())
        made.unfit = fmt::format("{}; {}", machine.problems.front().what, machine.problems.front().remedy);
      return made;
    }
    made.ratings = machine.drive->ratings;
    made.inertia_ratio = machine.drive->inertia_ratio;
    limit_inertia(motor, made);
    if (drive.is_servo())
      made.overrides.push_back({inertia_ratio, number_text(std::clamp(set_up_ * (1 + made.inertia_ratio) - 1,
                                                                      0.0, largest_inertia_ratio))});
    return made;
  }

  void limit_inertia(const scenario::MotorModel& motor, Candidate& made) const {
    const double makers = si_of(motor, "largest_inertia_ratio");
    if (choices_.most_inertia_ratio) {
      made.most_inertia_ratio = *choices_.most_inertia_ratio;
      made.limit_from = Candidate::LimitFrom::option;
    } else if (makers > 0) {
      made.most_inertia_ratio = makers;
      made.limit_from = Candidate::LimitFrom::maker;
    } else if (choices_.drive.is_servo()) {
      made.most_inertia_ratio = usual_inertia_ratio;
      made.limit_from = Candidate::LimitFrom::usage;
    }
    constexpr const char* said[] = {"", "is asked for", "is what its maker allows",
                                    "is usual, and the catalogue has no value of its maker"};
    if (made.unfit.empty() && made.is_too_heavy())
      made.unfit = fmt::format("load over rotor inertia {:.3g}, at most {:.3g} {}", made.inertia_ratio,
                               made.most_inertia_ratio, said[static_cast<std::size_t>(made.limit_from)]);
  }

  static double number_of_text(const std::string& text) { return scenario::parse_quantity(text)->number; }

  void take_along(Candidate& made, double factor, double present) const {
    if (factor == 1) return;
    if (word_in(plant_, "drive") == "pulses")
      take_electronic_gear(made, present);
    else if (const auto speed = number_in(plant_, "servo.speed_at_10v"))
      made.overrides.push_back({choices_.drive.path("servo.speed_at_10v"),
                                number_text(scenario::from_si(*speed * factor, "rpm")) + " rpm"});
    take_encoder(made, factor);
  }

  void take_electronic_gear(Candidate& made, double present) const {
    const auto set = [&](const char* word) {
      return static_cast<std::int64_t>(number_in(plant_, word).value_or(1));
    };
    const auto from = fraction_of(present);
    const auto to = fraction_of(number_of_text(made.gear));
    std::optional<Fraction> gear;
    if (from && to)
      gear =
          product(reduced({set("servo.pulses.gear_numerator"), set("servo.pulses.gear_denominator")}), *to);
    if (gear) gear = product(*gear, {from->second, from->first});
    if (!gear || gear->first > largest_gear_word || gear->second > largest_gear_word) {
      made.unfit = fmt::format("no electronic gear of whole numbers up to {} gives the same travel a pulse",
                               largest_gear_word);
      return;
    }
    made.overrides.push_back(
        {choices_.drive.path("servo.pulses.gear_numerator"), std::to_string(gear->first)});
    made.overrides.push_back(
        {choices_.drive.path("servo.pulses.gear_denominator"), std::to_string(gear->second)});
  }

  /// The lines of a motor's encoder behind a gear of so many times the present one, where the controller
  /// counts it; nothing if it does not.
  [[nodiscard]] std::optional<double> counted_lines(double factor) const {
    const auto lines = number_in(plant_, "encoder.lines");
    if (!counts_ || !lines || number_in(plant_, "encoder.on_drum").value_or(0) != 0) return {};
    return *lines / factor;
  }
  static bool is_whole(double lines) {
    return std::rint(lines) >= 1 && std::abs(lines - std::rint(lines)) <= 1e-9 * lines;
  }
  /// The same where it is no whole number.
  [[nodiscard]] std::optional<double> broken_lines(double factor) const {
    const auto lines = counted_lines(factor);
    return lines && !is_whole(*lines) ? lines : std::nullopt;
  }

  void take_encoder(Candidate& made, double factor) const {
    const auto counted = counted_lines(factor);
    if (!counted) return;
    const double wanted = *counted;
    if (is_whole(wanted)) {
      made.overrides.push_back({choices_.drive.path("encoder.lines"), number_text(std::rint(wanted))});
      return;
    }
    made.unfit = fmt::format(
        "no whole number of lines of the motor's encoder gives the controller the same counts ({:.6g})",
        wanted);
  }

  Candidate with_resistor(Candidate made, const BrakeResistor& resistor) const {
    const auto& drive = choices_.drive;
    made.resistor = resistor;
    if (resistor.ohm)
      made.overrides.push_back({drive.path(supply_ + "resistor"), number_text(*resistor.ohm) + " ohm"});
    if (resistor.power)
      made.overrides.push_back({drive.path(supply_ + "resistor_power"), number_text(*resistor.power) + " W"});
    const auto value = [&](const char* parameter) {
      return number_in(plant_, supply_ + parameter).value_or(0);
    };
    if (resistor.ohm.value_or(value("resistor")) <= 0) return made;
    made.resistor_power = resistor.power.value_or(value("resistor_power"));
    const double limit = value("overvoltage") - 1;
    made.braked_share = limit > 0 ? std::clamp((value("brake_voltage") - 1) / limit, 0.0, 1.0) : 0;
    return made;
  }

  const SizeChoices& choices_;
  const PointQuestion& question_;
  const scenario::PlantEntry& plant_;
  std::string supply_;
  std::vector<std::string> gears_;
  std::vector<BrakeResistor> resistors_;
  bool counts_ = false;  // the controller counts the encoder
  double set_up_ = 1;
};

void check_ratios(const SweepAxis& axis, Problems& problems) {
  for (const auto& value : axis.values) {
    const auto ratio = scenario::parse_quantity(value);
    if (!ratio || !ratio->unit.empty() || ratio->number <= 0)
      problems.push_back({"study.argument"_code, axis.parameter.option, 1, axis.parameter.low_column,
                          fmt::format("'{}' is no gear ratio", value),
                          "turns of the motor for one of the load, above 0: 5..20:16 or 5,7,10"});
  }
}

void check_count(const SizeChoices& choices, Problems& problems) {
  const auto gears = choices.gears.empty() ? 1 : grid_size(choices.gears, most_points).value_or(most_points);
  const auto resistors = std::max<std::size_t>(1, choices.resistors.size());
  const auto count = static_cast<double>(choices.motors.size() * resistors) * static_cast<double>(gears);
  if (count > static_cast<double>(most_candidates))
    problems.push_back({"study.out-of-range"_code, "--gears", 1, 1,
                        fmt::format("{} motors x {} gears x {} brake resistors are {:.0f} candidates",
                                    choices.motors.size(), gears, resistors, count),
                        fmt::format("at most {}", most_candidates)});
}

/// A gear by another value of the scenario that does not reach it would be none.
void check_gear_tie(const SizeChoices& choices, const PointQuestion& question, Problems& problems) {
  const auto& axis = choices.gears.front();
  std::vector<std::optional<double>> ratios;
  for (const auto& value : {axis.values.front(), axis.values.back()})
    ratios.push_back(probe_machine(question, choices.drive, overrides_of(choices.gears, {value})).ratio);
  if (axis.values.size() > 1 && ratios.front() && ratios.front() == ratios.back())
    problems.push_back(
        {"option.does-not-apply"_code, "--gears", 1, 1,
         fmt::format("{} does not change {}", axis.parameter.path, choices.drive.path("gear.ratio")),
         "tie it in the scenario, gear: {ratio: \"${gear}\"}, or write the ratios alone: --gears 5,7,10"});
}

/// What the reader says against a resistor it says against each.
void check_resistors(const SizeChoices& choices, const PointQuestion& question, Problems& problems) {
  for (const auto& resistor : choices.resistors) {
    const auto supply = choices.drive.path(choices.drive.supply());
    std::vector<scenario::Override> overrides;
    if (resistor.ohm) overrides.push_back({supply + "resistor", number_text(*resistor.ohm) + " ohm"});
    if (resistor.power) overrides.push_back({supply + "resistor_power", number_text(*resistor.power) + " W"});
    for (auto& problem : probe_machine(question, choices.drive, overrides).problems)
      problems.push_back(
          {problem.code, "--resistors", 1, 1, std::move(problem.what), std::move(problem.remedy)});
  }
}

}  // namespace

std::string name_of(const Candidate& candidate) {
  auto name = candidate.motor;
  if (!candidate.gear.empty()) name += ", gear " + candidate.gear;
  if (!candidate.gear_kind.empty()) name += " " + candidate.gear_kind;
  if (!candidate.resistor.text.empty()) name += ", resistor " + candidate.resistor.text;
  return name;
}

std::vector<Candidate> candidates_of(SizeChoices& choices, const PointQuestion& question,
                                     const scenario::Scenario& scenario, Problems& problems) {
  const auto before = problems.size();
  check_count(choices, problems);
  if (!choices.gears.empty()) {
    if (problems.size() == before) planned(choices.gears, {}, question, problems);
    if (problems.size() == before && !choices.gear_is_tied) check_ratios(choices.gears.front(), problems);
    if (problems.size() == before && choices.gear_is_tied) check_gear_tie(choices, question, problems);
  }
  check_resistors(choices, question, problems);
  if (problems.size() != before) return {};
  CandidateMaker maker(choices, question, scenario);
  if (auto note = maker.misfit_note(); !note.empty())
    choices.notes.emplace_back("size.gear-unfit"_code, std::move(note));
  return maker.run();
}

}  // namespace drycut::sim::studies
