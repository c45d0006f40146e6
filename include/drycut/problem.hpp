#pragma once
#include <string>
#include <vector>

namespace drycut {

/// One fault of an input text. Printed as `file:line:column: what; remedy`.
struct Problem {
  std::string file;    ///< name of the text as the user gave it
  int line = 0;        ///< 1-based
  int column = 0;      ///< 1-based
  std::string what;    ///< what is wrong
  std::string remedy;  ///< what would be right
};

/// All faults found in one run, in the order of the text.
using Problems = std::vector<Problem>;

}  // namespace drycut
