#pragma once
#include <string>
#include <vector>

#include "renders/plots.hpp"
#include "renders/report.hpp"
#include "sim/loop/played_cams.hpp"

namespace drycut::sim::cams {

/// What the report shows of one cam table that an axis played: the cam, how feasible it is at the fastest
/// master of the run, and how near to it the axis was.
struct CamPage {
  std::string title;
  std::string name;                ///< of its files, without extension: "AxisX"
  std::vector<std::string> notes;  ///< what a reader should know first
  std::vector<renders::Plot> plots;
  std::vector<renders::ReportTable> tables;
  std::string table;  ///< the cam table, for `drycut cam`
};

/// A page a table, in the order of their first start.
std::vector<CamPage> cam_pages(const std::vector<loop::PlayedCam>& played);

}  // namespace drycut::sim::cams
