#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/problem.hpp"
#include "base/table.hpp"
#include "sim/loop/known_events.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::studies {

// One point of a sweep: a scenario and overrides in, a row out. Nothing else is known here of points around
// it, of folders or of threads: whoever has the question can work on any of its points.

/// What is asked of every point.
struct PointQuestion {
  std::filesystem::path file;
  std::string text;  ///< of the file, read once
  std::vector<scenario::Override> set;
  struct Figure {
    std::string name;
    std::string term;  ///< as in `drycut tune`: "max(abs(knife.motor.torque))"

    template <typename Archive, typename Self>
    static void visit(Archive& archive, Self& self) {
      archive("name", self.name);
      archive("term", self.term);
    }
  };
  std::vector<Figure> figures;
  std::string rated =
      {};  ///< a drive of which a row has all that it is rated for (rated_drive.hpp); "" = none

  // What follows is found out by prepare().
  std::vector<loop::KnownEvent> events = {};
  std::vector<std::pair<std::string, std::string>> units = {};  ///< of the channels that figures look at
  struct Piece {
    std::string source;  ///< "knife"
    double from = 0;     ///< [s] the first check that looks at its cuts begins here
    bool has_mismatch = false;
    std::string length_unit;
    std::string mismatch_unit;
    double tolerance = 0;  ///< of the length, either way, as a plot states it; 0 = not said
  };
  std::vector<Piece> pieces = {};        ///< what cuts
  std::vector<std::string> drives = {};  ///< "knife.servo"
  std::vector<std::string> checks = {};  ///< by name
  std::vector<Column> columns = {};      ///< of a row's numbers

  /// What prepare() does not find out.
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("file", self.file);
    archive("text", self.text);
    archive("set", self.set);
    archive("figures", self.figures);
    archive("rated", self.rated);
  }
};

/// Columns by what they are of: a piece's source, a drive, a check, a figure.
std::string piece_key(const std::string& source, std::string_view what);
std::string drive_key(const std::string& drive, std::string_view what);
inline constexpr std::string_view margin_key = "margin.";

/// What came of a point.
struct PointRow {
  enum class Verdict {
    passed,    ///< every check and every rating holds
    failed,    ///< one does not
    refused,   ///< the scenario is none, or no machine can be built of it
    diverged,  ///< the simulation itself failed
    lost       ///< its worker on a cluster was lost
  };
  Verdict verdict = Verdict::passed;
  std::string limit;            ///< what failed first, or why there is no run; "" if nothing did
  std::string rating = {};      ///< "brake resistor: 110 of 100 W" where a drive's ratings are the limit
  std::vector<double> numbers;  ///< in the order of the columns; NaN = there is none
};
std::string_view name_of(PointRow::Verdict verdict);
/// What is the limit of a row, without figures: "drive within its ratings: brake resistor", "refused".
std::string region_of(const PointRow& row);
/// The same with all that is known of it: "drive within its ratings (brake resistor: 110 of 100 W)".
std::string limit_of(const PointRow& row);
/// How many rows have each verdict, those that some have: "12 passed, 8 failed, 180 refused (input wrong, not
/// simulated)".
std::string counts_of(const std::vector<PointRow::Verdict>& verdicts);

/// Finds out what the scenario can be asked and tells everything wrong with it and the figures.
void prepare(PointQuestion& question, Problems& problems);

/// A point that is read and not run yet.
struct PointScenario {
  scenario::Scenario scenario;    ///< nothing is drawn, and only what figures look at is recorded
  std::vector<double> lengths;    ///< wanted of each of the question's pieces [its unit]; NaN = not said
  Problems problems;              ///< why it is refused
  std::uint64_t fingerprint = 0;  ///< of all that its row depends on
};
PointScenario read_point(const PointQuestion& question, const std::vector<scenario::Override>& overrides);
/// The row of a run, from what came of it and its events; `lengths` are those of the point, `figures` the
/// numbers of the question's.
PointRow row_of(const PointQuestion& question, const std::vector<double>& lengths,
                const record::Outcome& outcome, const record::EventLog& events,
                const std::vector<double>& figures);
PointRow run_point(const PointQuestion& question, const PointScenario& point);

/// "checks[cut length].from" in place of "checks.0.from".
std::string with_check_names(const PointQuestion& question, const std::string& text);

std::string in_one_line(std::string text);
/// A row's cells behind the point's own: "passed,,,0.04,...", always the same way and back; nothing if `text`
/// is no such row.
std::string row_text(const PointRow& row);
std::optional<PointRow> parse_row(std::string_view text);

}  // namespace drycut::sim::studies
