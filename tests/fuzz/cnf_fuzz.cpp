// QMOVE configurations.
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/cnf.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  namespace qmove = devices::qmove;
  Problems problems;
  const auto configuration = qmove::parse_configuration(text, "f.cnf", devices::catalogue(), problems);
  fuzz::expect_placed(problems, text);
  if (!problems.empty()) return;
  qmove::QmoveController controller(configuration, {}, devices::catalogue(), 1'000'000);
  fuzz::run(controller, 2);
}

}  // namespace drycut
