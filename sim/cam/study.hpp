#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "renders/plots.hpp"
#include "sim/cam/columns.hpp"
#include "sim/cam/course.hpp"
#include "sim/cam/findings.hpp"
#include "sim/cam/ideal.hpp"
#include "sim/cam/motion_plot.hpp"
#include "sim/cam/points.hpp"

namespace drycut::sim {

/// What is asked of a cam table.
struct CamRequest {
  CamDuty duty;
  std::vector<double> at = {};  ///< master positions; empty = 1000 a pass and every boundary
  int loops = 1;                ///< times round, for a cam that jumps back
  std::string plot_name = "cam";
};

/// A cam in words: what it is, its sectors or rows, its totals; each ends with a line feed.
struct CamText {
  std::string heading;
  std::string sections;
  std::string totals;
  std::vector<std::pair<std::string, Columns>> tables = {};  ///< of `sections`, with their names
};

/// What a device makes of a cam table without a machine.
struct CamStudy {
  CamText text;
  std::vector<CamFinding> findings;
  std::vector<CamPoint> points;
  std::optional<double> master_per_s = {};  ///< speed of the master in its unit, if it is known
  renders::Plot plot;
  std::vector<CamPeak> peaks = {};  ///< of what is drawn
  bool rows_are_given = true;       ///< the device does not make them from parameters
  std::string table = {};           ///< rows that were generated, as a table that reads back; "" = none were
};

/// A kind of device that runs cams: one entry a kind is all that the commands know of it.
struct CamKind {
  std::string_view name;    ///< of --device
  std::string_view header;  ///< of its tables
  /// Whether a text is a table of this kind, by its header.
  bool (*owns)(std::string_view text);
  /// Reads a table; every fault becomes a problem with line and column. True if the table itself gives the
  /// speed of the master.
  bool (*check)(std::string_view text, const std::string& file, Problems& problems);
  /// Reads and runs it; the study means nothing if problems were told.
  CamStudy (*study)(std::string_view text, const std::string& file, const CamRequest& request,
                    Problems& problems);
  /// The cam that a table's text means; it does not run if there is a fault in it, which `study` tells.
  IdealCam (*ideal)(std::string_view text, MasterRange range);
};

/// All kinds; the first also takes what no other owns.
std::span<const CamKind> cam_kinds();
/// By the name of --device; "" = by the table's text, and a header that no kind knows has a kind without a
/// name, which tells all of theirs.
const CamKind& cam_kind(std::string_view name, std::string_view text);

/// Puts a drawing into a study.
void take(CamStudy& study, CamDrawing drawing);

/// What `drycut cam` prints: the cam in words with the findings before the totals.
std::string cam_report(const CamStudy& study);

/// Positions of --at that the cam does not have become problems.
void check_positions(const std::vector<double>& at, MasterRange range, std::string_view unit,
                     Problems& problems);
/// The first words of the header line: what is neither empty nor a comment, "" if there is nothing.
std::string_view header_line(std::string_view text);

}  // namespace drycut::sim
