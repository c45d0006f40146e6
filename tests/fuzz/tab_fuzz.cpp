// Cam tables of MC_CamIn: .tab and CSV.
#include "devices/plcopen/tab_file.hpp"
#include "sim/cams/study.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

DRYCUT_FUZZ(text) {
  Problems problems;
  devices::plcopen::parse_tab(text, "f.tab", problems);
  fuzz::expect_placed(problems, text);
  problems.clear();
  const auto table = sim::cams::read_cam("mc_camin", text, "f.csv", problems);
  fuzz::expect_placed(problems, text);
  if (!problems.empty()) return;
  const auto study = sim::cams::study_cam(table, sim::cams::CamRequest{.duty = {}, .at = {0, 1}}, problems);
  if (problems.empty()) sim::cams::cam_report(study.text, study.findings);
}

}  // namespace drycut
