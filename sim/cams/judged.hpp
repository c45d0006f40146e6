#pragma once
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/cams/course.hpp"
#include "sim/cams/study.hpp"
#include "sim/loop/cam_doubt.hpp"
#include "sim/loop/played_cams.hpp"

namespace drycut::sim::cams {

/// A cam that a run played, judged as drycut cam judges a table.
struct JudgedCam {
  std::string text;  ///< the table, for `drycut cam`
  devices::CamTable table;
  Problems problems;        ///< drycut cam does not take the table; then the rest means nothing
  IdealCam ideal = {};      ///< over what the master went
  CamStudy study = {};      ///< at the fastest that the master was ...
  double master_speed = 0;  ///< ... 0 = it did not move, or the table itself says how fast it is
};
/// Of which file findings name lines: the one that the run leaves, or the user's own.
enum class Lines { written, own };
/// `name` is that of its file and its plot.
JudgedCam judged(const loop::PlayedCam& played, const std::string& name, Lines lines = Lines::written);

/// What speaks against the cams: errors and passed limits of the tables themselves are slips; what is only
/// too much at the speed that the master had, and warnings, are none. Cautions are left out.
/// Beside them how long their cycles are.
loop::CamJudgement cam_judgement(const std::vector<loop::PlayedCam>& played);

}  // namespace drycut::sim::cams
