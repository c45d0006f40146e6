#pragma once
#include <string>
#include <utility>
#include <vector>

namespace drycut::sim::cams {

/// A number that cures a finding when it is put in.
struct CamCure {
  int row = 0;            ///< sector or row of the table, 0 = of the whole cam
  std::string parameter;  ///< a column, a parameter; "master speed" of the duty; "begin": the slave's way on
  double value = 0;
};
/// What would be right, in words, and the numbers that it names: each cures, a "stroke" with its "begin".
struct CamRemedy {
  CamRemedy(std::string words = "", std::vector<CamCure> numbers = {})
      : text(std::move(words)), cures(std::move(numbers)) {}
  CamRemedy(const char* words) : text(words) {}
  std::string text;
  std::vector<CamCure> cures;
};

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
  int number = 0;     ///< of the device's error or warning, 0 = it has none
  std::string where;  ///< "sector 4 (135 DZC)", "row 12"; "" = of the whole cam
  std::string text;
  CamRemedy remedy;  ///< may be empty
};

/// "sector 4 (135 DZC): warning 7: ...; ...".
std::string to_string(const CamFinding& finding);

/// True if one is an error or a limit, or with `strict` a warning or a caution.
bool is_unsound(const std::vector<CamFinding>& findings, bool strict);

/// All findings, one a line, or "no finding".
std::string findings_text(const std::vector<CamFinding>& findings);

/// A number for a reader: up to ten significant digits, no "-0".
std::string number_text(double number, int digits = 10);

/// What rounding may add to a limit that is just met, as a factor.
inline constexpr double within = 1 + 1e-9;
/// A number as findings tell it: six digits.
std::string number(double value);
/// A positive number that a remedy names as the most: rounded down, so that it is sound itself.
std::string number_below(double value);
/// The same of one that it names as the least: rounded up.
std::string number_above(double value);
/// "... run the master at 90 Um/s at most".
CamRemedy slower_master(const std::string& words, double most, const std::string& unit);
/// A whole number with all of its digits.
std::string whole(double value);

}  // namespace drycut::sim::cams
