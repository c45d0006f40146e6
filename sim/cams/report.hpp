#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/cams/course.hpp"
#include "sim/cams/findings.hpp"

namespace drycut::sim::cams {

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
