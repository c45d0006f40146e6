#include "sim/cams/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/sheet.hpp"

namespace drycut::sim::cams {

std::string plain(double value) { return number_text(std::abs(value) < 1e-9 ? 0 : value, 6); }

void Columns::add(std::vector<std::string> cells, std::size_t most) {
  if (lines_.size() < most)
    lines_.push_back(std::move(cells));
  else
    ++more_;
}

std::string Columns::text() const {
  std::vector<std::vector<std::string>> all(2);
  for (const auto& heading : headings_) {
    all[0].push_back(heading.name);
    all[1].push_back(heading.unit);
  }
  if (std::all_of(all[1].begin(), all[1].end(), [](const auto& unit) { return unit.empty(); }))
    all.pop_back();
  all.insert(all.end(), lines_.begin(), lines_.end());
  std::vector<bool> numbers;
  for (const auto& heading : headings_) numbers.push_back(!heading.words);
  auto text = in_columns(all, 0, numbers);
  return more_ == 0 ? text : text + fmt::format("  ... and {} more{}\n", more_, why_);
}

std::string totals_text(const CamCourse& course, const std::string& master_unit,
                        const std::string& slave_unit, const std::string& more) {
  auto text = fmt::format("master total {} {}, slave total {} {}{}", number_text(course.master_total()),
                          master_unit, number_text(course.slave_total()), slave_unit, more);
  if (course.master_speed) text += fmt::format(", {} s", plain(course.master_total() / *course.master_speed));
  return text + '\n';
}

std::string cam_report(const CamText& text, const std::vector<CamFinding>& findings) {
  std::string sections;
  for (const auto& [name, columns] : text.tables) sections += (sections.empty() ? "" : "\n") + columns.text();
  if (sections.empty()) sections = "nothing to run\n";
  return text.heading + '\n' + sections + '\n' + findings_text(findings) + text.totals;
}

std::string cam_csv(const std::vector<CamPoint>& points, std::optional<double> master_per_s) {
  std::string text(cam_csv_header);
  if (master_per_s) text += ",time,velocity_t,acceleration_t,jerk_t";
  text += '\n';
  const auto out = std::back_inserter(text);
  for (const auto& p : points) {
    // Adding 0 turns -0 into 0.
    fmt::format_to(out, "{},{},{},{},{},{}", p.master + 0.0, p.position + 0.0, p.velocity + 0.0,
                   p.acceleration + 0.0, p.jerk + 0.0, p.row);
    if (master_per_s) {
      const double v = *master_per_s;
      fmt::format_to(out, ",{},{},{},{}", p.master / v + 0.0, p.velocity * v + 0.0,
                     p.acceleration * v * v + 0.0, p.jerk * v * v * v + 0.0);
    }
    text += '\n';
  }
  return text;
}

std::string cam_samples_text(const std::vector<CamPoint>& points) {
  Columns columns({{"master"}, {"slave"}, {"velocity"}, {"acceleration"}, {"jerk"}, {"sector"}});
  for (const auto& p : points)
    columns.add({number_text(p.master), number_text(p.position), number_text(p.velocity),
                 number_text(p.acceleration), number_text(p.jerk), std::to_string(p.row)},
                points.size());
  return columns.text();
}

}  // namespace drycut::sim::cams
