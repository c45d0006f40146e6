#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "sim/studies/bode/loop.hpp"
#include "sim/studies/tune/metric.hpp"

namespace drycut::sim::studies {

/// What is measured on which scenarios: all that a tuning holds fixed.
struct Study {
  struct Case {
    std::filesystem::path file;
    std::string text;                               ///< of the file, read once
    std::vector<loop::KnownEvent> events;           ///< that its plants can report
    std::map<std::string, std::string> units = {};  ///< of the channels that metric and constraints look at
    std::string play = {};  ///< and stiction of the plant at the wire: "axis.gap 0.4 mm"

    template <typename Archive, typename Self>
    static void visit(Archive& archive, Self& self) {
      archive("file", self.file);
      archive("text", self.text);
    }
  };
  std::vector<Case> cases;
  std::vector<scenario::Override> set;  ///< applied before what the tuning changes
  std::string minimise;
  std::vector<std::string> constraints;
  LoopRequest loop;         ///< how the figures of the loop are measured; pushes: found out by prepare()
  bool needs_loop = false;  ///< a constraint limits one of them; found out by prepare()
  Time from = 0;
  bool ignore_checks = false;
  std::string metric_unit;              ///< by prepare(); "" = none that could be said
  std::vector<std::string> room_units;  ///< of the room that each constraint leaves, likewise

  /// What prepare() does not find out.
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("cases", self.cases);
    archive("set", self.set);
    archive("minimise", self.minimise);
    archive("constraints", self.constraints);
    archive("loop", self.loop);
    archive("from", self.from);
    archive("ignore_checks", self.ignore_checks);
  }

  /// Simulated runs that one set of values may take: two more a scenario where the loop is measured, and two
  /// more where there is play or stiction, for pushes.
  [[nodiscard]] int runs_of_a_trial() const {
    return static_cast<int>(cases.size()) * (1 + (needs_loop ? 2 : 0) + (loop.pushes ? 2 : 0));
  }
};

/// What one set of values is worth, over all scenarios: the worst of each number.
struct Verdict {
  double metric = 0;         ///< NaN if it could not be measured
  std::vector<double> room;  ///< one a constraint, negative beyond it; NaN = not measured
  int failed_checks = 0;
  bool stopped = false;   ///< a run ended early, could not begin or gave no number
  bool doubtful = false;  ///< the loop was measured, and what came of it is not to be trusted
  double violation = 0;   ///< 0 = all limits kept; else their number and, below 1 each, how far beyond
  /// Where there is play: from how many times the gain on it hunts; infinite: every push died out; NaN: not
  /// known.
  double hunts_from = std::numeric_limits<double>::quiet_NaN();
  int runs = 0;      ///< simulated runs that it took
  std::string note;  ///< first thing that failed

  [[nodiscard]] bool feasible() const { return !stopped && violation == 0; }
  /// True if all that was measured keeps its limit, but a margin gave no number; `note` says why.
  [[nodiscard]] bool unmeasured() const;
  /// Smaller is better, always: what keeps all limits comes before what does not.
  [[nodiscard]] double rank() const;
};

/// One run of one scenario, kept to be looked at.
struct KeptRun {
  record::Recording recording;
  record::Outcome outcome;
  std::string expanded;  ///< the scenario with every value in force
};

/// Runs all scenarios of `study` with `overrides` on top. The loop is measured and pushed last, and only
/// where the values keep all other limits and their metric is less than `to_beat`: it takes longer than all
/// the rest.
Verdict measure(const Study& study, const std::vector<scenario::Override>& overrides,
                double to_beat = std::numeric_limits<double>::infinity());
/// The run of one scenario with the channels that metric and constraints look at; throws
/// std::runtime_error if it cannot be built.
KeptRun keep_run(const Study& study, const Study::Case& scenario,
                 const std::vector<scenario::Override>& overrides);

/// Every name that metric and constraints look at, once.
std::vector<MetricName> names_of(const Study& study, const Study::Case& scenario);

/// Reads the scenarios' events and units into `study` and tells everything wrong with scenarios, --set,
/// metric and constraints.
void prepare(Study& study, Problems& problems);

}  // namespace drycut::sim::studies
