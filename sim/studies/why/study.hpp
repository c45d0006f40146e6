#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/record/outcome.hpp"
#include "sim/studies/why/announced.hpp"
#include "sim/studies/why/branches.hpp"
#include "sim/studies/why/mixture.hpp"

namespace drycut::sim::studies {

/// What is asked of a run that failed.
struct WhyRequest {
  std::filesystem::path run;   ///< its folder, or a scenario
  std::filesystem::path good;  ///< likewise, of one that passes; "" = there is none
  std::string check;           ///< "" = the one that failed first
  int budget = 200;            ///< simulated runs
  int jobs = 1;
};

/// A sign of the chain before a failure.
struct ChainLink {
  loop::Sign sign;
  bool also_good = false;  ///< the good run has it, too

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    loop::Sign::visit(archive, self.sign);
    archive("also_good", self.also_good);
  }
};

/// A difference, and what became of it.
struct WeighedDifference {
  std::string where;
  std::string good;
  std::string failed;
  bool is_cause = false;
  std::string alone =
      {};  ///< what it comes to alone: "passed", "failed", "unresolved"; "" = that was not tried
  std::string note = {};  ///< why it is unresolved

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("where", self.where);
    archive("good", self.good);
    archive("failed", self.failed);
    archive("is_cause", self.is_cause);
    archive("alone", self.alone);
    archive("note", self.note);
  }
};

/// Curves for the page: of the good run and of the one that fails.
struct WhyCurves {
  record::Recording good;
  record::Recording failed;
  RoomOverTime good_room;
  RoomOverTime failed_room;
  std::vector<std::string> channels;
  bool by_event = false;  ///< the room is of single events
};

struct WhyFound {
  std::string run;
  std::string good;
  std::string check;                ///< "" = the simulation stopped
  std::optional<double> failed_at;  ///< [s]
  std::string unit;                 ///< of the check's room
  std::string detail;               ///< of the check, in words
  std::optional<double> sign_at;    ///< [s] of the first sign
  std::string sign;                 ///< what that was; "" = nothing announced it
  std::string because;              ///< as the run itself tells it; "" = it does not
  std::vector<ChainLink> chain;
  std::optional<Slide> slide;
  std::vector<WeighedDifference> differences;
  bool minimal = false;       ///< none of the cause can be left away
  bool other_causes = false;  ///< without the cause what failed fails all the same
  int runs = 0;
  int budget = 0;
  std::optional<Parting> parting;
  std::optional<PointOfReturn> point_of_return;
  std::vector<Finding> findings;
  std::optional<WhyCurves> curves;

  [[nodiscard]] std::vector<const WeighedDifference*> cause() const;
  /// True if there is an answer: of two runs a least difference, of one what it tells.
  [[nodiscard]] bool is_found() const;

  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("run", self.run);
    archive("good", self.good);
    archive("check", self.check);
    archive("failed_at", self.failed_at);
    archive("sign_at", self.sign_at);
    archive("sign", self.sign);
    archive("because", self.because);
    archive("chain", self.chain);
    archive("differences", self.differences);
    archive("minimal", self.minimal);
    archive("other_causes", self.other_causes);
    archive("runs", self.runs);
    archive("budget", self.budget);
    archive("parting", self.parting);
    archive("point_of_return", self.point_of_return);
    archive("findings", self.findings);
  }
};

/// Answers the request. What is wrong with it, or turns out to be when it runs (what should be good fails),
/// is told in `problems`; then there is no answer. `progress` is told what it does, and how much of the
/// budget is used.
std::optional<WhyFound> find_why(const WhyRequest& request, Problems& problems,
                                 const std::function<void(const char* doing, double share)>& progress);

}  // namespace drycut::sim::studies
