// QCL modules, against a configuration with one device of each type.
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/program.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {
namespace {

namespace qmove = devices::qmove;

const qmove::Configuration& configuration() {
  static const auto made = [] {
    Problems problems;
    auto read = qmove::parse_configuration(
        "CONST\ncTen 10\nSYSTEM\nslA L\nsfA F\nsbA B\nswA W\nssA S\nGLOBAL\nglA L\nARRSYS\nasA L "
        "3\nARRGBL\nagA W 5\n"
        "TIMER\ntmA\nDATAGROUP\ndgA\nDATAPROGRAM 2\nddlA L\nSTEP 3\nddbA B\n"
        "BUS\n1 1CPUB 02\n2 1MIXA 00\n3 1MIXA 00\n"
        "INPUT\nifA F 2.INP05\nOUTPUT\nofA F 2.OUT05\n"
        "INTDEVICE\n"
        "AxisX CAMMING4 2 2.CNT01 2.CNT02 X.X 1 2.INP01 2 2.INP02 2.INP03 5 2.AN01 2.OUT01\n"
        "Axis EPICPOS 4 3.CNT01 3 3.INP01 3.AN01\n"
        "Master EANPOS 4 1.CNT01 X X.X X.X\n"
        "Press OOPOS2 4 3.CNT02 X 3.INP02 3.OUT01 3.OUT02 3.OUT03 3.OUT04 3.OUT05 3.OUT06\n"
        "END\n",
        "f.cnf", devices::catalogue(), problems);
    if (!problems.empty()) fuzz::broken(to_string(problems.front()));
    return read;
  }();
  return made;
}

}  // namespace

DRYCUT_FUZZ(text) {
  Problems problems;
  auto program = qmove::compile_module(text, "f.mod", configuration(), devices::catalogue(), problems);
  fuzz::expect_placed(problems, text);
  if (!problems.empty()) return;
  qmove::QmoveController controller(configuration(), {std::move(program)}, devices::catalogue(), 1'000'000);
  fuzz::run(controller, 20);
}

}  // namespace drycut
