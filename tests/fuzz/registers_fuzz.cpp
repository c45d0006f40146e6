// Register files of the LX3VP and its retentive state.
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "devices/lx3vp/register_file.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  namespace lx3vp = devices::lx3vp;
  for (const char separator : {',', '='}) {
    Problems problems;
    lx3vp::is_register_file(text, separator);
    lx3vp::read_register_values(text, "f.csv", separator, problems);
    fuzz::expect_placed(problems, text);
  }
  Problems problems;
  lx3vp::Lx3vpController controller(lx3vp::il::compile("END\n", "f.il", problems), 1'000'000);
  if (controller.restore(std::string(text), problems)) fuzz::run(controller, 1);
}

}  // namespace drycut
