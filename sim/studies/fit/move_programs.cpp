#include "sim/studies/fit/move_programs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sim/studies/fit/move_files.hpp"

namespace drycut::sim::studies {

namespace {

/// What each program says of the chirp, "" without one.
std::string chirp_remark(const FitMove& move, std::string_view remark) {
  if (!move.chirp) return "";
  return fmt::format(
      "{0} The slow strokes at the end carry the chirp: the drive's generator adds it, no controller can. "
      "See "
      "move.txt.\n",
      remark);
}

/// One line a stroke: what it is for, where the part changes.
std::string part_remark(const std::vector<MoveStroke>& strokes, std::size_t i, std::string_view remark) {
  if (i > 0 && strokes[i - 1].part == strokes[i].part) return "";
  return fmt::format("{} {}\n", remark, words_of(strokes[i].part));
}

/// Units of a QMOVE positioner.
struct QmoveUnits {
  int decimals = 0;
  long long resolution = 0;  ///< cntratio
  int time = 0;              ///< unitvel: 0 speeds per minute, 1 per second
  long long top = 0;         ///< maxvel

  [[nodiscard]] long long place(double value) const { return std::llround(value * std::pow(10, decimals)); }
  [[nodiscard]] long long speed(double a_minute) const {
    return std::llround(time == 0 ? a_minute : a_minute / minute_s);
  }
};

QmoveUnits qmove_units(const FitMove& move) {
  const auto& axis = move.axis;
  double farthest = std::max(std::abs(axis.low), std::abs(axis.high));
  double place = axis.start;
  for (const auto& stroke : strokes_of(move)) {
    place += stroke.turns * axis.per_turn;
    farthest = std::max(farthest, std::abs(place));
  }
  constexpr double bits_a_line = 4;
  constexpr double hundred_thousand = 1e5;
  constexpr double largest = 999999;
  constexpr double largest_ratio = 400000;
  QmoveUnits units;
  for (units.decimals = 3; units.decimals >= 0; --units.decimals) {
    const double scale = std::pow(10, units.decimals);
    units.resolution = std::llround(axis.per_turn / axis.counts * bits_a_line * scale * hundred_thousand);
    if (static_cast<double>(units.resolution) <= largest_ratio && farthest * scale <= largest) break;
  }
  const double top = axis.speed_at_10v * axis.per_turn;
  units.time = top <= largest ? 0 : 1;
  units.top = units.speed(top);
  return units;
}

std::string qmove_configuration(const FitMove& move) {
  return fmt::format(
      ";-----\n; Commissioning move of {}: see plan.mod\n;-----\n"
      "CONST\n\nSYSTEM\n\nGLOBAL\n"
      "gwStroke    W                     ; stroke that runs\n"
      "gbDone      B                     ; 1: the move is over\n"
      "glPlace     L                     ; of a stroke: where it ends\n"
      "glSpeed     L                     ; its speed\n"
      "gwRamp      W                     ; from rest to maxvel [1/100 s]\n\n"
      "TIMER\ntmRest\n\nBUS\n1 1CPUB 02\n2 1MIXA 00\n\n"
      "INPUT\nifStart     F 2.INP03             ; begin\n\n"
      "OUTPUT\nofDone      F 2.OUT01             ; the move is over\n\n"
      "INTDEVICE\n;      TCamp ICont   IntL IAZero  IOutA\nAxis  EANPOS 2 2.CNT01 1 X.X 2.AN01\n\nEND\n",
      move.axis.plant);
}

std::string qmove_module(const FitMove& move) {
  const auto& axis = move.axis;
  const auto units = qmove_units(move);
  const auto strokes = strokes_of(move);
  const long long widest = 999999;
  std::string text = fmt::format(
      ";-----\n; Commissioning move of {}, made by drycut fit --plan: strokes from rest to rest.\n"
      "; Places are in {:.{}f} {}, speeds in {}/{}. 2.INP03 begins, 2.OUT01 is on when it is over.\n"
      "; Put the axis to {:.6g} {} first. Gains: those of your own commissioning.\n{}",
      axis.plant, std::pow(10, -units.decimals), units.decimals, axis.unit, axis.unit,
      units.time == 0 ? "min" : "s", axis.start, axis.unit, chirp_remark(move, ";"));
  text += fmt::format(
      ";-----\nAxis:cntratio = {}\nAxis:decpt    = {}\nAxis:unitvel  = {}\nAxis:maxvel   = {}\n"
      "Axis:minpos   = {}\nAxis:maxpos   = {}\nAxis:maxfollerr = 2000000\nAxis:rampmode = 0\n"
      "Axis:ramptype = 0\nAxis:toll     = {}\nAxis:feedfw   = 1000\nAxis:pgain    = 50\n\n",
      units.resolution, units.decimals, units.time, units.top,
      axis.linear ? units.place(axis.low) - 1 : -widest, axis.linear ? units.place(axis.high) + 1 : widest,
      std::max(1LL, units.place(1)));
  text += fmt::format(
      "INIT Axis\nWAIT Axis:st_init\nLOOPON Axis\nWAIT Axis:st_loopon\nCNTUNLOCK Axis\n"
      "WAIT NOT Axis:st_cntlock\n{}\nREGON Axis\nWAIT NOT Axis:st_regoff\n"
      "Axis:posit = {}\nWAIT ifStart\n",
      axis.reversed ? "CNTREV Axis\nWAIT Axis:st_cntrev" : "CNTDIR Axis\nWAIT NOT Axis:st_cntrev",
      units.place(axis.start));
  double place = axis.start;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const auto& stroke = strokes[i];
    place += stroke.turns * axis.per_turn;
    constexpr double hundredths = 100;
    text += "\n" + part_remark(strokes, i, ";") +
            fmt::format("glPlace = {}\nglSpeed = {}\ngwRamp = {}\nCALL Stroke\n", units.place(place),
                        std::max(1LL, units.speed(std::abs(stroke.speed) * axis.per_turn)),
                        std::llround(hundredths * stroke.ramp * axis.speed_at_10v / std::abs(stroke.speed)));
  }
  return text +
         "\ngbDone = 1\nofDone = 1\nMAIN:\nWAIT 1\nJUMP MAIN\n\n"
         "SUB Stroke\n    gwStroke = gwStroke + 1\n    Axis:taccdec = gwRamp\n    Axis:setvel = glSpeed\n"
         "    Axis:setpos = glPlace\n    START Axis\n    WAIT NOT Axis:st_still\n    WAIT Axis:st_still\n"
         "    tmRest = 200\n    WAIT tmRest\nENDSUB\nEND\n";
}

std::vector<std::string> numbers(const std::vector<MoveStroke>& strokes, auto value) {
  std::vector<std::string> texts;
  texts.reserve(strokes.size());
  for (const auto& stroke : strokes) texts.push_back(fmt::format("{:.1f}", value(stroke)));
  return texts;
}

/// The highest speed and acceleration of all strokes, of the load [unit/s, unit/s2].
std::pair<double, double> highest(const FitMove& move) {
  double speed = 0;
  double acceleration = 0;
  for (const auto& stroke : strokes_of(move)) {
    const double own = std::abs(stroke.speed) * move.axis.per_turn / minute_s;
    speed = std::max(speed, own);
    acceleration = std::max(acceleration, own / stroke.ramp);
  }
  return {speed, acceleration};
}

std::string st_program(const FitMove& move) {
  const auto& axis = move.axis;
  const auto strokes = strokes_of(move);
  constexpr double places = 1e4;
  constexpr double speeds = 1e3;
  const auto array = [&](const char* name, const char* about, auto value) {
    return fmt::format("  {} : ARRAY[1..{}] OF LREAL := [\n    {}];  // {}\n", name, strokes.size(),
                       fmt::join(numbers(strokes, value), ", "), about);
  };
  const auto* small = axis.linear ? "0.1 um" : "0.0001 deg";
  std::string text = fmt::format(
      "// Commissioning move of {}, made by drycut fit --plan: strokes from rest to rest.\n"
      "// Put the axis to {:.6g} {} first. IX0.0 begins, QX0.0 is on when it is over.\n{}",
      axis.plant, axis.start, axis.unit, chirp_remark(move, "//"));
  for (std::size_t i = 0; i < strokes.size(); ++i)
    if (const auto remark = part_remark(strokes, i, "//"); !remark.empty())
      text += fmt::format("// from stroke {} on: {}\n", i + 1, words_of(strokes[i].part));
  text += fmt::format(
      "PROGRAM plan\nVAR_EXTERNAL\n  Machine : AXIS_REF;\nEND_VAR\nVAR CONSTANT\n  STROKES : DINT := {};\n"
      "END_VAR\nVAR\n  start AT %IX0.0 : BOOL;\n  done AT %QX0.0 : BOOL;\n",
      strokes.size());
  text += array("way", small, [&](const auto& one) { return one.turns * axis.per_turn * places; });
  text += array("speed", axis.linear ? "um/s" : "0.001 deg/s",
                [&](const auto& one) { return std::abs(one.speed) * axis.per_turn / minute_s * speeds; });
  text += array("ramp", axis.linear ? "mm/s2" : "deg/s2",
                [&](const auto& one) { return std::abs(one.speed) * axis.per_turn / minute_s / one.ramp; });
  return text +
         "  stroke : DINT := 1;\n  moves : BOOL;\n\n  Power : MC_Power;\n  Move : MC_MoveRelative;\n"
         "  Rest : TON;\nEND_VAR\n\n"
         "IF Power.Status AND start AND stroke <= STROKES THEN moves := TRUE; END_IF\n"
         "IF Move.Done AND Rest.Q THEN\n  moves := FALSE;         // the next scan gives the next edge\n"
         "  stroke := stroke + 1;\nEND_IF\n"
         "IF Move.Error THEN moves := FALSE; stroke := STROKES + 2; END_IF\n"
         "done := stroke = STROKES + 1;\n\n"
         "Power(Axis := Machine, Enable := TRUE);\n"
         "Move(Axis := Machine, Execute := moves, Distance := way[MIN(stroke, STROKES)],\n"
         "     Velocity := speed[MIN(stroke, STROKES)], Acceleration := ramp[MIN(stroke, STROKES)],\n"
         "     Deceleration := ramp[MIN(stroke, STROKES)]);\n"
         "Rest(IN := moves AND Move.Done, PT := T#200ms);\nEND_PROGRAM\n";
}

/// Of all strokes [rpm].
double top_speed(const std::vector<MoveStroke>& strokes) {
  double top = 0;
  for (const auto& one : strokes) top = std::max(top, std::abs(one.speed));
  return top;
}

/// A turn of the motor: what its electronic gear has, or fewer, where the top speed is too fast for the
/// output.
double pulses_for(const FitMove& move) {
  constexpr double fastest = 200000;  // [Hz]
  constexpr double round = 100;
  const double most = std::floor(fastest / (top_speed(strokes_of(move)) / minute_s) / round) * round;
  return std::min(*move.axis.pulses_per_turn, most);
}

std::string il_program(const FitMove& move) {
  const auto strokes = strokes_of(move);
  const double pulses = pulses_for(move);
  const double top = top_speed(strokes);
  std::string text = fmt::format(
      "; Commissioning move of {}, made by drycut fit --plan: strokes from rest to rest.\n"
      "; {:.10g} pulses a turn of the motor: set its electronic gear so. Put the axis to {:.6g} {} first. X0 "
      "begins, Y20 is on when it "
      "is over.\n{}"
      "; D100 stroke  DD200 its pulses  DD202 its frequency [Hz]  D8148 from rest to the top speed [ms]\n"
      "; M0 the next stroke  M1 moves  M2 rests\n\n"
      "LD      M8002\nDMOV    K{} D8146\nMOV     K0 D8145\nMOV     K0 D100\n"
      "LD      X0\nAND=    D100 K0\nINC     D100\nSET     M0\n",
      move.axis.plant, pulses, move.axis.start, move.axis.unit, chirp_remark(move, ";"),
      std::llround(top / minute_s * pulses));
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const auto& one = strokes[i];
    constexpr double ms = 1000;
    text +=
        "\n" + part_remark(strokes, i, ";") +
        fmt::format("LD=     D100 K{}\nDMOV    K{} D200\nDMOV    K{} D202\nMOV     K{} D8148\n", i + 1,
                    std::llround(one.turns * pulses), std::llround(std::abs(one.speed) / minute_s * pulses),
                    std::llround(ms * one.ramp * top / std::abs(one.speed)));
  }
  return text +
         fmt::format(
             "\nLD      M0\nAND<=   D100 K{0}\nSET     M1\nLD      M0\nRST     M0\n"
             "LD      M1\nDDRVI   D200 D202 Y0 Y4\nLD      M1\nAND     M8029\nRST     M1\nSET     M2\n"
             "LD      M2\nOUT     T10 K2\nLD      M2\nAND     T10\nRST     M2\nINC     D100\nSET     M0\n"
             "LD>     D100 K{0}\nOUT     Y20\nEND\n",
             strokes.size());
}

}  // namespace

MoveProgram qmove_program(const FitMove& move) {
  const auto& plant = move.axis.plant;
  MoveProgram program{"qmove",
                      "QEM QMOVE, EANPOS",
                      {{"plan.cnf", qmove_configuration(move)}, {"plan.mod", qmove_module(move)}},
                      {},
                      fmt::format("controller: {{qmove: {{configuration: plan.cnf, tasks: [plan.mod]}}}}\n"
                                  "wiring:\n  2.CNT01: {0}.encoder\n  INT1: {0}.encoder.index\n"
                                  "  2.AN01: {0}.servo.reference\n  2.INP03: panel.start\n  2.OUT01: "
                                  "panel.done\n",
                                  plant)};
  if (move.axis.drive == "pulses") program.plants.emplace_back("drive", "servo");
  return program;
}

MoveProgram plcopen_program(const FitMove& move) {
  const auto& axis = move.axis;
  const auto [speed, acceleration] = highest(move);
  constexpr double room = 1.05;
  constexpr double turns = 10;  // counts need not be whole for one
  const double at_10v = axis.speed_at_10v * axis.per_turn / minute_s;
  MoveProgram program{
      "plcopen",
      "PLCopen, Structured Text",
      {{"plan.st", st_program(move)}},
      {},
      fmt::format(
          "controller:\n  plcopen:\n    program: plan.st\n    cycle: 2 ms\n    axes:\n      Machine:\n"
          "        modulo: 0 {0}\n        path: [{1:.8g} {0}, {2}]\n        homed_at_start: on\n"
          "        antr.v_at_10v: {3:.8g} {0}/s\n"
          "        dynamik: {{vb_max: {4:.6g} {0}/s, a_max: {5:.6g} {0}/s2, tr_min: 2 ms}}\n        kv: 25 "
          "1/s\n"
          "wiring:\n  Machine.encoder: {6}.encoder\n  Machine.reference: {6}.servo.reference\n"
          "  Machine.enable: {6}.servo.enable\n  IX0.0: panel.start\n  QX0.0: panel.done\n",
          axis.unit, turns * axis.per_turn, std::llround(turns * axis.counts), at_10v, room * speed,
          2 * room * acceleration, axis.plant)};
  if (axis.drive == "pulses") program.plants.emplace_back("drive", "servo");
  if (axis.reversed) program.plants.emplace_back("encoder.reverse", "false");
  return program;
}

MoveProgram lx3vp_program(const FitMove& move) {
  MoveProgram program{"lx3vp",
                      "Wecon LX3VP, pulses",
                      {{"plan.il", il_program(move)}},
                      {},
                      fmt::format("controller: {{lx3vp: {{program: plan.il}}}}\n"
                                  "wiring:\n  Y0: {0}.servo.pulses\n  Y4: {0}.servo.direction\n  X0: "
                                  "panel.start\n  Y20: panel.done\n",
                                  move.axis.plant)};
  if (move.axis.drive != "pulses") program.plants.emplace_back("drive", "pulses");
  if (const double pulses = pulses_for(move); pulses < *move.axis.pulses_per_turn) {
    program.plants.emplace_back("servo.pulses.gear_numerator",
                                fmt::format("{:.0f}", move.axis.pulse_resolution));
    program.plants.emplace_back("servo.pulses.gear_denominator", fmt::format("{:.0f}", pulses));
  }
  return program;
}

}  // namespace drycut::sim::studies
