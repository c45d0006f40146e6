#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/sim/command_bench.hpp"

namespace drycut::sim::studies::bode_axis {

namespace fs = std::filesystem;

/// EPICPOS with its loop closed round an ideal axis: 1 m/s at 10 V and at maxvel, 10 um a count, TCamp 4 ms.
/// The loop is then L(z) = pgain / 1000 / (z - 1): speed is voltage, and the count of a sampling instant
/// makes the voltage of the same instant.
struct Folder : TestFolder {
  Folder() {
    file("axis.cnf",
         "BUS\n1 1CPUB 02\n2 1MIXA 00\n\nINTDEVICE\nAxis EPICPOS 4 2.CNT01 X X.X 2.AN01\n\nEND\n");
    file("axis.mod", program("LOOPON Axis\n"));
    file("axis.yaml", scenario(""));
  }
  static std::string program(const std::string& loop) {
    return "Axis:cntratio = 100000\nAxis:maxpos = 999999\nAxis:minpos = -999999\n"
           "Axis:maxfollerr = 900000\nAxis:unitvel = 1\nAxis:decpt = 0\nAxis:taccdec = 100\nAxis:toll = 5\n"
           "Axis:feedfw = 0\nAxis:integt = 0\nAxis:derivt = 0\nINIT Axis\nWAIT Axis:st_init\nCNTUNLOCK Axis\n"
           "CNTDIR Axis\nREGON Axis\nRESUME Axis\nWAIT NOT Axis:st_emrg\n" +
           loop + "MAIN:\nWAIT 1\nJUMP MAIN\nEND\n";
  }
  /// The same, never at rest.
  static std::string restless() {
    return program(
        "LOOPON Axis\nWAIT Axis:st_loopon\nAxis:setvel = 20000\nAGAIN:\nAxis:setpos = 2000\nSTART "
        "Axis\nWAIT NOT Axis:st_still\nWAIT Axis:st_still\nAxis:setpos = 0\nSTART Axis\nWAIT NOT "
        "Axis:st_still\nWAIT Axis:st_still\nJUMP AGAIN\n");
  }
  /// The same loop round a servo motor with a ball screw: 2 um a count, 10 V is maxvel.
  static std::string screw() {
    return "scene: {step: 100 us, duration: 500 ms}\n"
           "plants:\n  axis: {type: linear_axis}\n"
           "controller:\n  qmove:\n    configuration: axis.cnf\n    tasks: [axis.mod]\n"
           "    set: {Axis.pgain: 200, Axis.maxvel: 83333}\n"
           "wiring: {2.CNT01: axis.encoder, 2.AN01: axis.servo.reference}\nrecord: {channels: "
           "[Axis.posit]}\n";
  }
  /// The scenario with `more` sections.
  static std::string scenario(const std::string& more) {
    return "scene: {step: 500 us, duration: 500 ms}\n"
           "plants:\n  axis: {type: ideal_axis, speed_at_10v: 1000 mm/s, resolution: 0.01 mm}\n"
           "controller:\n  qmove:\n    configuration: axis.cnf\n    tasks: [axis.mod]\n"
           "    set: {Axis.pgain: 100, Axis.maxvel: 25000}\n"
           "wiring: {2.CNT01: axis.encoder, 2.AN01: axis.reference}\n"
           "record: {channels: [Axis.posit]}\n" +
           more;
  }
};

}  // namespace drycut::sim::studies::bode_axis
