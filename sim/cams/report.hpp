#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/cams/course.hpp"

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
  Prose text;
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
  Code kind = Code();
  Grade grade = Grade::remark;
  int number = 0;     ///< of the device's error or warning, 0 = it has none
  std::string where;  ///< "sector 4 (135 DZC)", "row 12"; "" = of the whole cam
  Prose text;
  CamRemedy remedy;  ///< may be empty
};

/// "warning 7"
std::string grade_text(const CamFinding& finding);
/// "sector 4 (135 DZC): warning 7: ...; ...".
std::string sentence(const CamFinding& finding);
/// The same, with its code in brackets behind it.
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

/// Of a report's pieces and knots.
inline constexpr std::size_t most_lines = 60;

/// A number of a report: what is 0 but for rounding is 0.
std::string plain(double value);

/// Columns of text, as wide as their widest cells; numbers to the right, words to the left.
class Columns {
 public:
  struct Heading {
    std::string name;
    std::string unit = {};
    bool words = false;
  };
  explicit Columns(std::vector<Heading> headings) : headings_(std::move(headings)) {}
  /// Lines beyond `most` are only counted.
  void add(std::vector<std::string> cells, std::size_t most = most_lines);
  /// What to say of the lines that were left out.
  void left_out(std::string why) { why_ = std::move(why); }
  /// With the headings in two lines, and what was left out.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::vector<Heading>& headings() const { return headings_; }
  [[nodiscard]] const std::vector<std::vector<std::string>>& lines() const { return lines_; }

 private:
  std::vector<Heading> headings_;
  std::vector<std::vector<std::string>> lines_;
  std::size_t more_ = 0;
  std::string why_ = {};
};

/// A cam in words: what it is, its sectors or rows, its totals.
struct CamText {
  std::string heading;                                       ///< ends with a line feed
  std::vector<std::pair<std::string, Columns>> tables = {};  ///< with their names
  std::string totals = {};                                   ///< ends with a line feed
};

/// "master total 700 Um, slave total 565 Um, 1.2 s"; `more` stands before the time.
std::string totals_text(const CamCourse& course, const std::string& master_unit,
                        const std::string& slave_unit, const std::string& more);

/// What `drycut cam` prints: the cam in words with the findings before the totals.
std::string cam_report(const CamText& text, const std::vector<CamFinding>& findings);

inline constexpr std::string_view cam_csv_header = "master,slave,velocity,acceleration,jerk,sector";
/// A table of these columns, and with the master's speed [units/s] `time,velocity_t,acceleration_t,jerk_t`
/// [s, slave units/s, /s2, /s3]. Numbers read back to the same bits.
std::string cam_csv(const std::vector<CamPoint>& points, std::optional<double> master_per_s);

/// The samples of `--at` as a table.
std::string cam_samples_text(const std::vector<CamPoint>& points);

}  // namespace drycut::sim::cams
