#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/studies/faults/question.hpp"

namespace drycut::sim::studies {

/// Scenarios that repeat a cell with pictures: they extend the line's and add the fault.
class CellScenarios {
 public:
  /// They will lie in `folder`, and name the line's file from there.
  CellScenarios(const FaultQuestion& question, const std::filesystem::path& folder);

  /// What is one cell's: texts of a scenario, or places for them as "{8}".
  struct Values {
    std::string comment;    ///< what it is
    std::string component;  ///< "knife.encoder"
    std::string fault;      ///< "lose_counts"
    std::string quantity;   ///< "2000"
    std::string at;         ///< "6.1 s"
    std::string until;      ///< end of the branch
  };
  [[nodiscard]] std::string text(const Values& values) const;
  static Values values_of(const TriedFault& fault, const FaultMoment& moment, std::string comment);
  /// "knife.encoder.lose_counts at 37.yaml", fit for a file.
  static std::string file_name(const TriedFault& fault, const FaultMoment& moment);

 private:
  std::string line_;                   ///< its file, as the scenarios name it
  std::string entries_;                ///< of its own timeline
  bool around_ = false;                ///< its frames are about an event
  std::vector<std::string> sections_;  ///< what --set changed
  std::vector<std::string> also_;      ///< what of that only a command line can say
};

}  // namespace drycut::sim::studies
