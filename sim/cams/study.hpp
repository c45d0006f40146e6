#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "devices/cam/table.hpp"
#include "sim/cams/course.hpp"
#include "sim/cams/csv.hpp"
#include "sim/cams/motion_plot.hpp"
#include "sim/cams/report.hpp"

namespace drycut::sim::cams {

/// What is asked of a cam table.
struct CamRequest {
  CamDuty duty;
  std::vector<double> at = {};  ///< master positions; empty = 1000 a pass and every boundary
  int loops = 1;                ///< times round, for a cam that jumps back
  std::string plot_name = "cam";
};

/// What a device makes of a cam table without a machine. The kinds fill in all but the last three.
struct CamStudy {
  CamCourse course = {};
  std::vector<CamZone> zones = {};  ///< what the slave does in a cycle of it, in the table's units
  CamMotionWords motion = {};
  CamText text = {};
  std::vector<CamFinding> findings = {};
  std::string master_unit = {};  ///< of the table
  std::string file = {};         ///< from which its rows were read; "" = from none
  bool rows_are_given = true;    ///< the device does not make them from parameters
  std::string table = {};        ///< rows that were generated, as a table that reads back; "" = none were
  std::vector<CamPoint> points = {};
  renders::Plot plot = {};
  std::vector<CamPeak> peaks = {};  ///< of what is drawn
};

/// A kind of device that runs cams, as a file's text shows it.
struct CamKind {
  std::string_view name;    ///< of --device
  std::string_view header;  ///< of its tables
  /// Whether a text is a table of this kind, by its header.
  bool (*owns)(std::string_view text);
  /// Reads a table; every fault becomes a problem with line and column, and the table means nothing.
  devices::CamTable (*read)(std::string_view text, const std::string& file, Problems& problems);
  /// Its keys, `# key: value`, and its columns, as the reference tells them.
  std::vector<CamKey> (*keys)() = nullptr;
  std::vector<CamKey> (*columns)() = nullptr;
  /// Of its own tables only: all that there is to say of a cam but its samples; the cam that a run is
  /// compared with; the text of a file.
  CamStudy (*study)(const devices::CamTable& table, const CamRequest& request, Problems& problems) = nullptr;
  IdealCam (*ideal)(const devices::CamTable& table, MasterRange range) = nullptr;
  std::string (*file)(devices::CamTable& table, const std::string& file) = nullptr;
};

/// All kinds; the first also takes what no other owns.
std::span<const CamKind> cam_kinds();
/// By the name of --device; "" = by the table's text, and a header that no kind knows has a kind without a
/// name, which tells all of theirs.
const CamKind& cam_kind(std::string_view name, std::string_view text);
/// A table as `device` reads it, "" = as its text shows; it means nothing if problems were told.
devices::CamTable read_cam(std::string_view device, std::string_view text, const std::string& file,
                           Problems& problems);
/// Runs, judges, samples and draws a cam; the study means nothing if problems were told.
CamStudy study_cam(const devices::CamTable& table, const CamRequest& request, Problems& problems);
/// The cam that a table means; it does not run if there is a fault in it, which the study tells.
IdealCam ideal_cam(const devices::CamTable& table, MasterRange range);
/// True if the table itself gives the speed of the master.
bool gives_master_speed(const devices::CamTable& table);
/// A controller's table as the text of a file that reads back. The table is then as if it had been read from
/// it: with the file's name and the lines of its rows.
std::string cam_file(devices::CamTable& table, const std::string& file);

/// The first words of the header line: what is neither empty nor a comment, "" if there is nothing.
std::string_view header_line(std::string_view text);

}  // namespace drycut::sim::cams
