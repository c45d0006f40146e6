#include "sim/studies/fit/move_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/json.hpp"
#include "base/output_file.hpp"
#include "base/text.hpp"
#include "sim/studies/fit/move_programs.hpp"

namespace drycut::sim::studies {

namespace {

double margin_of(const MoveAxis& axis) {
  constexpr double of_way = 0.05 / 0.9;
  return of_way * (axis.high - axis.low);
}

std::string_view name_of(MovePart part) {
  switch (part) {
    case MovePart::approach:
      return "approach";
    case MovePart::constant_speeds:
      return "constant speeds";
    case MovePart::ramps:
      return "ramps";
    case MovePart::slow:
      return "slow";
    case MovePart::whole:
      return "whole";
    case MovePart::chirp:
      break;
  }
  return "chirp";
}

/// `extends` the user's scenario, of which only the machine stays.
std::string machine_text(const FitPlan& plan, const FitMove& move, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const auto base = fs::relative(fs::absolute(plan.question.file), fs::absolute(folder));
  std::string text =
      fmt::format("# The machine of {} alone, where the move begins.\nextends: {}\n",
                  plan.question.file.filename().string(), json_text(Json(base.generic_string())));
  const auto read = [&](const std::string& trial) {
    Problems problems;
    auto scenario = scenario::read_scenario_text(trial, folder / "machine.yaml", {}, problems);
    return std::pair{std::move(scenario), std::move(problems)};
  };
  // What is not there cannot be left out.
  for (const auto* section : {"controller", "wiring", "filters", "panel", "timeline", "disturbances",
                              "inputs", "record", "drives", "faults", "checks", "pictures", "opcua"}) {
    const auto line = fmt::format("{}: ~\n", section);
    const auto problems = read(text + line).second;
    if (std::ranges::none_of(problems, [](const auto& one) { return one.code == "scenario.unknown-name"; }))
      text += line;
  }
  // Numbers of --set are those of the machine that was asked for.
  Json tree = Json::object();
  for (const auto& one : plan.question.set) {
    if (!one.path.starts_with("plants.") && !one.path.starts_with("variables.") &&
        !one.path.starts_with("scene."))
      continue;
    auto* node = &tree;
    for (std::size_t at = 0; at <= one.path.size();) {
      const auto dot = std::min(one.path.find('.', at), one.path.size());
      node = &(*node)[one.path.substr(at, dot - at)];
      at = dot + 1;
    }
    *node = one.value;
  }
  auto& plants = tree["plants"];
  if (move.axis.linear)
    plants[move.axis.plant]["start"] = fmt::format("{:.8g} {}", move.axis.start, move.axis.unit);
  // No material: the web stands, and the machine is where none of it is.
  const auto machine = read(text).first;
  for (const auto& plant : machine.plants)
    if (plant.type.text == "web") plants[plant.name.text]["speed"] = "0 m/min";
  if (!move.axis.web.empty()) {
    plants[move.axis.web]["outfeed.length"] = "100 m";
    plants[move.axis.plant]["place"] = "90 m";
  }
  if (plants.empty()) tree.erase("plants");
  for (const auto& [key, value] : tree.items()) text += fmt::format("{}: {}\n", key, json_text(value));
  return text;
}

/// The drive's chirp as the simulation has it: sines one after the other.
std::string chirp_steps(const FitMove& move, double begin) {
  if (!move.chirp) return "";
  constexpr int steps = 40;
  constexpr double late = 1;  // of the controller, at most
  std::string text = fmt::format(
      "# The chirp of the drive's generator, as {} sines one after the other.\ndisturbances:\n", steps);
  for (const auto& stroke : strokes_of(move)) {
    if (stroke.part != MovePart::chirp) continue;
    const double from = begin + stroke.begin + stroke.ramp + late;
    const double each = (stroke.along - 2 * late) / steps;
    for (int i = 0; i < steps; ++i)
      text += fmt::format(
          "  - {{at: {}.servo.test_torque, kind: sine, amplitude: {:.4g} N m, frequency: {:.4g} Hz, from: "
          "{:.4f} "
          "s, to: {:.4f} s}}\n",
          move.axis.plant, move.chirp->amplitude,
          move.chirp->from * std::pow(move.chirp->to / move.chirp->from, i / (steps - 1.0)), from + i * each,
          from + (i + 1) * each);
  }
  return text;
}

std::string scenario_text(const FitMove& move, const MoveProgram& program) {
  const auto& axis = move.axis;
  constexpr double begin = 0.2;
  constexpr double most = 0.8;
  const double length = std::ceil(begin + 1.1 * move.seconds() + 2);
  std::string text = fmt::format(
      "# The commissioning move of {0} under {1}. Look at it before you do it on the machine:\n"
      "# drycut run plan_{2}.yaml; its trace.csv is what you are to record.\n"
      "extends: machine.yaml\nscene: {{title: \"Commissioning move of {0} under {1}\", duration: {3:.0f} "
      "s}}\n",
      axis.plant, program.maker, program.controller, length);
  if (!program.plants.empty()) {
    Json plants;
    for (const auto& [row, value] : program.plants) plants[axis.plant][row] = value;
    text += fmt::format("plants: {}\n", json_text(plants));
  }
  text += program.sections;
  text += fmt::format("timeline:\n  - {{at: {:.6g} s, set: {{panel.start: 1}}}}\n", begin);
  text += chirp_steps(move, begin);
  const auto* place = axis.linear ? "position" : "angle.total";
  text += fmt::format(
      "record: {{every: {2:.6g} ms, channels: [{0}.motor.torque, {0}.motor.speed, {0}.encoder.count, "
      "{0}.{1}]}}\n",
      axis.plant, place, 1000 / move.sampling);
  text += "drives: {judge: off}\n";
  text += fmt::format(
      "checks:\n  - {{name: the move is over, eventually: panel.done == 1, within: {0:.0f} s}}\n"
      "  - {{name: torque below {1:.0f} % of the peak, always: \"abs({2}.motor.torque) <= {3:.4g} N m\"}}\n",
      length, 100 * most, axis.plant, most * axis.peak_torque);
  if (axis.linear)
    text += fmt::format(
        "  - {{name: within the travel, always: \"{0}.position >= {1:.6g} mm && {0}.position <= {2:.6g} "
        "mm\"}}\n",
        axis.plant, axis.low - 0.25 * margin_of(axis), axis.high + 0.25 * margin_of(axis));
  text += fmt::format(
      "pictures:\n  plots:\n    - name: move\n      title: What the machine does\n      panels:\n"
      "        - {{title: speed, channels: [{0}.motor.speed]}}\n"
      "        - {{title: torque, channels: [{0}.motor.torque]}}\n"
      "        - {{title: position, channels: [{0}.{1}]}}\n",
      axis.plant, place);
  return text;
}

/// Counts a turn of the motor that the chirp's motion asks for: five in its amplitude near the resonance.
double counts_for(const MoveAxis& axis, const MoveChirp& chirp) {
  constexpr double turn = 2 * std::numbers::pi;
  constexpr double counts = 5;
  const double omega = turn * chirp.to / 2;
  return turn * counts * axis.inertia * omega * omega / chirp.amplitude;
}

/// What a recording needs.
std::string recording_text(const FitMove& move) {
  const auto& axis = move.axis;
  constexpr double fine = 0.001;
  std::string text = fmt::format(
      "Record {:.0f} s without a gap, a sample each {:.3g} ms or more often ({:.0f} Hz), all channels by one "
      "clock:\n"
      "  motor torque, measured (not commanded), in steps of {:.2g} N m (0.1 % of rated) or finer\n"
      "  position of the motor, in counts of its encoder\n",
      std::ceil(move.seconds() + 1), 1000 / move.sampling, move.sampling, fine * axis.rated_torque);
  if (!move.chirp) return text;
  const double wanted = counts_for(axis, *move.chirp);
  if (axis.counts < wanted)
    text += fmt::format(
        "  but for the chirp the {:.6g} counts a turn are too coarse: position or speed of the drive's own "
        "encoder,\n  {:.2g} counts a turn or more\n",
        axis.counts, wanted);
  return text + (axis.linear ? "  position of the carriage, if there is a scale\n"
                             : "  position of the load, if it has an encoder\n");
}

}  // namespace

std::string_view words_of(MovePart part) {
  switch (part) {
    case MovePart::approach:
      return "to where the move begins, and back";
    case MovePart::constant_speeds:
      return "constant speeds both ways: dry and viscous friction";
    case MovePart::ramps:
      return "ramps with much torque: mass, inertia";
    case MovePart::slow:
      return "slow reversals: friction near standstill, play";
    case MovePart::whole:
      return "all of the way, slowly: weight, unbalance";
    case MovePart::chirp:
      break;
  }
  return "a chirp of torque on a slow motion: stiffness, damping, play";
}

std::string move_text(const FitMove& move) {
  const auto& axis = move.axis;
  std::string text = fmt::format("Commissioning move of {}, {:.1f} s, for the drive's own generator\n\n",
                                 axis.plant, move.seconds());
  for (const auto& path : move.vary)
    text += fmt::format("  {:<40} {}\n", path.text(), words_of(part_for(path)));
  text += "\n" + recording_text(move);
  text += axis.linear ? fmt::format("\nIt begins at {:.6g} mm and stays between {:.6g} and {:.6g} mm.",
                                    axis.start, axis.low, axis.high)
                      : std::string("\nIt turns both ways without end: take off what must not turn.");
  text += fmt::format(
      " No material in it.\nPlanned with {:.3g} kg m2 at the motor and {:.3g} N m of friction and weight, as "
      "the "
      "scenario has them. If they are far off,\nwatch the torque, begin with half the speeds, and plan again "
      "with what you then know.\n",
      axis.inertia, axis.drag);
  text += fmt::format("\nSpeeds are of the motor; {:.8g} {} a turn.\n\n", axis.per_turn, axis.unit);
  text += fmt::format("{:>4}  {:<16}{:>12}{:>12}{:>10}{:>14}\n", "no", "part", "from [rpm]", "to [rpm]",
                      "time [s]", fmt::format("at [{}]", axis.unit));
  double place = axis.start;
  for (std::size_t i = 0; i < move.segments.size(); ++i) {
    const auto& one = move.segments[i];
    place += one.turns() * axis.per_turn;
    text += fmt::format("{:>4}  {:<16}{:>12.2f}{:>12.2f}{:>10.3f}{:>14.3f}\n", i + 1, name_of(one.part),
                        one.from, one.to, one.seconds, place);
  }
  if (move.chirp)
    text += fmt::format(
        "\nChirp, added to the torque along each constant speed of the part 'chirp': from {:.3g} Hz to "
        "{:.3g} Hz, "
        "rising by\nequal ratios in equal times, amplitude {:.3g} N m ({:.0f} % of rated). {} Stop it where "
        "the "
        "machine grows loud.\n",
        move.chirp->from, move.chirp->to, move.chirp->amplitude,
        100 * move.chirp->amplitude / axis.rated_torque,
        axis.resonance > 0
            ? fmt::format("The scenario has the\nantiresonance at {:.3g} Hz and the resonance at {:.3g} Hz.",
                          axis.antiresonance, axis.resonance)
            : std::string("The scenario does not say where\nthe resonance is."));
  return text;
}

std::string move_summary(const FitMove& move) {
  std::string text =
      fmt::format("{} in {:.1f} s\n", counted(std::ssize(strokes_of(move)), "stroke"), move.seconds());
  for (const auto& path : move.vary) text += fmt::format("{}: {}\n", path.text(), words_of(part_for(path)));
  text += recording_text(move);
  if (!move.axis.pulses_per_turn)
    text += fmt::format("No program for LX3VP: the servo of {} takes no pulses.\n", move.axis.plant);
  return text;
}

std::string move_table(const FitMove& move) {
  const auto& axis = move.axis;
  std::string text = fmt::format("time [s],speed [rpm],speed [{0}/s],position [{0}],part\n", axis.unit);
  double time = 0;
  double place = axis.start;
  const auto row = [&](double speed, MovePart part) {
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.8g},{}\n", time, speed, speed * axis.per_turn / minute_s,
                        place, name_of(part));
  };
  row(0, MovePart::approach);
  for (const auto& one : move.segments) {
    time += one.seconds;
    place += one.turns() * axis.per_turn;
    row(one.to, one.part);
  }
  return text;
}

void write_move(const FitPlan& plan, const FitMove& move, OutputFolder& folder) {
  const auto write = [&](const std::string& name, const std::string& text) {
    write_file(folder.add(name), text);
  };
  write("move.csv", move_table(move));
  write("move.txt", move_text(move));
  write("machine.yaml", machine_text(plan, move, folder.path()));
  std::vector<MoveProgram> programs = {qmove_program(move), plcopen_program(move)};
  if (move.axis.pulses_per_turn) programs.push_back(lx3vp_program(move));
  for (const auto& program : programs) {
    for (const auto& [name, text] : program.files) write(name, text);
    write(fmt::format("plan_{}.yaml", program.controller), scenario_text(move, program));
  }
}

}  // namespace drycut::sim::studies
