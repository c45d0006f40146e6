// Instruction lists of the LX3VP.
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  namespace lx3vp = devices::lx3vp;
  Problems problems;
  auto program = lx3vp::il::compile(text, "f.il", problems);
  fuzz::expect_placed(problems, text);
  if (!problems.empty()) return;
  lx3vp::Lx3vpController controller(std::move(program), 1'000'000);
  fuzz::run(controller, 20);
}

}  // namespace drycut
