// Cam tables of CAMMING4 and the LX3VP as CSV, sampled and judged.
#include "sim/cams/study.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  for (const char* device : {"camming4", "lx3vp"}) {
    Problems problems;
    const auto table = sim::cams::read_cam(device, text, "f.csv", problems);
    fuzz::expect_placed(problems, text);
    if (!problems.empty()) continue;
    const auto study = sim::cams::study_cam(table, sim::cams::CamRequest{.duty = {}, .at = {0, 1}}, problems);
    if (problems.empty()) sim::cams::cam_report(study.text, study.findings);
  }
}

}  // namespace drycut
