#pragma once
#include <drycut/problem.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renders/machine_view.hpp"
#include "renders/plots.hpp"
#include "renders/report_data.hpp"
#include "renders/report_matrix.hpp"

namespace drycut::renders {

struct ReportCheck {
  std::string name;
  std::string expectation;  ///< as the scenario states it
  bool passed = false;
  std::string margin;               ///< "0.053 mm left at 7.204 s", "" if none can be said
  std::string detail;               ///< "15 cuts, worst length = 800.047 mm"
  std::optional<double> used = {};  ///< share of its limit, drawn as a bar: 1 = all of it, above: beyond it
  bool nothing = false;             ///< it passed, for it found nothing to judge
  bool so_far = false;              ///< it held until the run stopped, which is no verdict
};

/// A figure that says much of a run in little room; they stand on top.
struct ReportKey {
  Prose label;                      ///< "length of cut"
  std::string value;                ///< "800.003 ± 0.012 mm"
  std::vector<std::string> notes;   ///< "worst 800.031 mm: no. 7 at 7.204 s"
  std::optional<double> used = {};  ///< share of what it may be, drawn as a bar
};

struct ReportRow {
  std::vector<std::string> cells;
};
struct ReportTable {
  Prose title;
  std::vector<Prose> headings;
  std::vector<ReportRow> rows;
  bool folded = false;  ///< shown closed, to be opened by a click
  /// Cells that begin with PASS or FAIL show the word as a badge; what follows a line end is shown small.
  bool verdicts = false;
};

/// Headings and rows for a terminal, wrapped to `width` characters; 0 = no limit.
std::string rows_text(const ReportTable& table, std::size_t width);

struct ReportFigure {
  std::filesystem::path png;
  Prose caption;     ///< below it; "" = none
  Prose words = {};  ///< what it shows, for who cannot see it
};

/// A part of the page about one thing: what to know, plots, tables; what is folded stays with it.
struct ReportSection {
  Prose title;
  std::vector<std::string> notes;
  std::vector<ReportFigure> plots;
  std::vector<ReportTable> tables;
};

/// A text to copy as it stands.
struct ReportText {
  Prose title;
  std::string text;
};

/// What a customer gets to read.
struct Report {
  Prose title;
  std::string scenario;  ///< file name
  bool passed = false;
  std::string word;  ///< in place of PASS or FAIL where nothing was judged: "SAME", "DIFFERENT"
  Prose verdict;     ///< "all 5 checks passed", "2 of 5 checks failed", "the simulation stopped: ..."
  std::vector<ReportKey> keys = {};
  std::vector<ReportRow> facts;   ///< label, value: duration, step, seed, versions
  Prose checks_title = "Checks";  ///< of which run, where there are several
  std::vector<ReportCheck> checks;
  std::vector<std::string> notes = {};  ///< what a reader should know besides, behind the checks
  std::vector<ReportTable> summary;     ///< what is read before the pictures: a comparison
  std::vector<ReportText> texts = {};   ///< to copy
  std::vector<ReportMap> maps = {};     ///< before the frames
  std::vector<ReportMatrix> matrices = {};
  std::vector<ReportFigure> frames;      ///< chosen frames, shown as a strip
  std::filesystem::path video;           ///< MP4 of all frames, "" = none
  std::filesystem::path poster = {};     ///< PNG that stands for it until it plays, as large
  std::optional<MachineView> view = {};  ///< stands above the plots and shows the time of their cursor
  std::vector<std::string> units = {};   ///< the device's own units, explained where the plots begin
  std::vector<ReportFigure> plots;
  std::vector<ReportSection> sections = {};  ///< behind the plots
  /// The plots as data, one a figure in `plots` and then in `sections`, for a browser to zoom; or none.
  std::vector<Plot> live;
  std::vector<ReportTable> tables;  ///< pieces, events, parameters in force
  std::string scenario_expanded;    ///< the scenario with every default in force
};

/// Writes one HTML file that opens offline: pictures inside, no script needed to read it, light and dark,
/// readable on a phone and in print. Where a script runs, the plots with data can be zoomed; the library for
/// that (dygraphs) is taken from its installed package, without it the pictures stay. Written under a
/// temporary name and renamed, so that a half report never stands there. Throws std::runtime_error if a
/// picture cannot be read or the file not written.
void write_report(const Report& report, const std::filesystem::path& file);

}  // namespace drycut::renders
