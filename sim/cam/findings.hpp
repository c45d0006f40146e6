#pragma once
#include <string>
#include <vector>

#include "sim/cam/run.hpp"

namespace drycut::sim {

/// One thing found in a cam.
struct CamFinding {
  enum class Grade {
    error,    ///< the device stops the axis
    limit,    ///< a velocity or an acceleration that the axis must not have
    warning,  ///< the device warns and goes on
    caution,  ///< the device says nothing; good practice or the manual does
    remark    ///< about the validation
  };
  Grade grade = Grade::remark;
  int number = 0;  ///< of the device's error or warning
  int row = 0;     ///< 0: of the whole cam
  int codeG = 0;
  int pass = 1;
  std::string text;
  std::string remedy;  ///< may be empty
};

/// "sector 4 (135 DZC): warning 7: ...; ...".
std::string to_string(const CamFinding& finding);

/// Everything wrong or noteworthy, each once, in the order of running; remarks come last.
std::vector<CamFinding> judge(const CamTable& table, const CamDuty& duty, const CamRun& run);

/// True if one is an error or a limit, or with `strict` a warning or a caution.
bool is_unsound(const std::vector<CamFinding>& findings, bool strict);

/// "132 AZM"; "999" for a code that does not exist.
std::string code_text(int code);
/// A number for a reader: up to ten significant digits, no "-0".
std::string number_text(double number, int digits = 10);

}  // namespace drycut::sim
