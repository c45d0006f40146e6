// Cam tables of CAMMING4 and the LX3VP as CSV, sampled and judged.
#include "sim/cam/study.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  for (const char* device : {"camming4", "lx3vp"}) {
    Problems problems;
    const auto study =
        sim::cam_kind(device, text).study(text, "f.csv", sim::CamRequest{.duty = {}, .at = {0, 1}}, problems);
    fuzz::expect_placed(problems, text);
    if (problems.empty()) sim::cam_report(study);
  }
}

}  // namespace drycut
