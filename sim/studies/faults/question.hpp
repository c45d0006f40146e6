#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "sim/scenario/scenario.hpp"

namespace drycut::sim::studies {

/// More cells than these are a slip of the keyboard.
inline constexpr std::size_t most_cells = 1'000'000;
/// A branch goes on for so many machine cycles behind the time in which somebody must be told.
inline constexpr int cycles_behind = 3;

/// A fault that is tried.
struct TriedFault {
  std::string component;  ///< "knife.encoder", "wire.2.INP01"
  std::string name;       ///< "lose_counts"
  double value = 0;       ///< [SI]
  std::string unit;       ///< in which scenarios give it

  /// "knife.encoder.lose_counts"
  [[nodiscard]] std::string full() const { return component + "." + name; }
  /// "2000", "5 %"
  [[nodiscard]] std::string quantity() const;
};

/// When it comes.
struct FaultMoment {
  std::string name;             ///< "37 %" of the machine cycle, "at knife.cut", "5.25 s"
  std::optional<double> phase;  ///< of the cycle [%]
  Time at = 0;
  Time until = 0;             ///< the branch ends here
  bool cuts = false;          ///< without a fault there are cuts in the last cycles of it
  StateArchive::Bytes state;  ///< of the line
};

/// Every fault at every moment of one line.
struct FaultQuestion {
  std::filesystem::path file;
  std::string text;  ///< of the file, read once
  std::vector<scenario::Override> set;
  int moments = 100;
  bool at_events = false;         ///< also when each kind of event happens
  std::vector<std::string> only;  ///< patterns of faults by their full names; none: all

  // What follows is found out by prepare().
  std::shared_ptr<const scenario::Scenario> scenario = {};  ///< with product checks alone
  std::vector<TriedFault> faults = {};
  std::vector<FaultMoment> when = {};
  std::string cutter = {};                  ///< whose cuts make the cycle; "" = nothing cuts
  Time begin = 0;                           ///< of the cycle
  Time cycle = 0;                           ///< its length; 0 = there is none
  std::set<std::string> known_damage = {};  ///< that the line does without a fault: "saw.crash"
  std::vector<Finding> notes = {};

  [[nodiscard]] std::size_t cells() const { return faults.size() * when.size(); }

  /// What prepare() does not find out.
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("file", self.file);
    archive("text", self.text);
    archive("set", self.set);
    archive("moments", self.moments);
    archive("at_events", self.at_events);
    archive("only", self.only);
  }
};

/// Reads the scenario, runs it without a fault, finds the faults that it offers and the moments, and keeps
/// its state at each of them. What is wrong goes to `problems`.
void prepare(FaultQuestion& question, Problems& problems);

}  // namespace drycut::sim::studies
