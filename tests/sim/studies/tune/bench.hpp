#pragma once
// A tuning with a known answer: an axis without mass, 10 V = maxvel exactly, so that feed-forward 1000 leaves
// no following error.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/cli/tune_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::studies::tuning {

namespace fs = std::filesystem;

inline const std::string feedfw = "controller.qmove.set.AxisX.feedfw";
inline const std::string pgain = "controller.qmove.set.AxisX.pgain";

inline const char* const configuration = R"(CONST
SYSTEM
GLOBAL
gbPhase B
BUS
1 1CPUB 02
2 1MIXA 00
INPUT
OUTPUT
INTDEVICE
AxisX EPICPOS 2 2.CNT01 X X.X 2.AN01
END
)";
inline const char* const program = R"(AxisX:cntratio = 100000
AxisX:decpt = 2
AxisX:maxpos = 999999
AxisX:minpos = - 999999
AxisX:maxvel = 60000
AxisX:toll = 100
AxisX:maxfollerr = 100000
AxisX:taccdec = 20
INIT AxisX
WAIT AxisX:st_init
LOOPON AxisX
WAIT AxisX:st_loopon
CNTUNLOCK AxisX
CNTDIR AxisX
REGON AxisX
WAIT NOT AxisX:st_regoff
AxisX:setvel = 30000
AxisX:setpos = 40000
START AxisX
MAIN:
WAIT 1
JUMP MAIN
END
)";
inline const char* const scenario = R"(scene: {step: 1 ms, duration: 1 s}
plants:
  axis: {type: ideal_axis, speed_at_10v: 1000 mm/s, resolution: 0.0025 mm}
controller:
  qmove: {configuration: axis.cnf, tasks: [axis.mod], set: {AxisX.pgain: 0, AxisX.feedfw: 900}}
wiring: {2.CNT01: axis.encoder, 2.AN01: axis.reference}
record: {every: 2 ms, channels: [AxisX.follerr, axis.position]}
)";

struct Bench : CommandTest {
  Bench() {
    test_folder.file("axis.cnf", configuration);
    test_folder.file("axis.mod", program);
    options.scenarios = {test_folder.file("axis.yaml", scenario)};
    options.vary = {feedfw + "=700..1250"};
    options.minimise = "rms(AxisX.follerr)";
    options.budget = 60;
    options.pictures = false;
    options.out = folder / "out";
  }
  int run() {
    return captured([&] { return cli::tune_scenarios(options); });
  }

  TestFolder test_folder;
  const fs::path& folder = test_folder.path;
  cli::TuneOptions options;
};

}  // namespace drycut::sim::studies::tuning
