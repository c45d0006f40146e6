#include "sim/record/outcome.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace drycut::sim::record {

namespace {

constexpr double percent = 100;

}  // namespace

bool DriveVerdict::holds() const { return trips.empty() && (figures.empty() || tightest().share <= 1); }

const DriveFigure& DriveVerdict::tightest() const {
  return *std::max_element(figures.begin(), figures.end(), [](const auto& a, const auto& b) {
    return (a.judged ? a.share : 0) < (b.judged ? b.share : 0);
  });
}

std::string text_of(const DriveVerdict& verdict) {
  const auto& figure = verdict.tightest();
  auto text =
      verdict.drive + (verdict.alike > 1 ? fmt::format(", each of {}: ", verdict.alike) : std::string(": "));
  text += fmt::format("{}", fmt::join(verdict.trips, ", "));
  // Behind a trip only what is over its limit tells something.
  if (verdict.trips.empty() || figure.share > 1)
    text +=
        fmt::format("{}{} {:.4g} of {:.4g} {} ({:.0f} %, {})", verdict.trips.empty() ? "" : "; ", figure.name,
                    figure.value, figure.rating, figure.unit, figure.share * percent, figure.window);
  std::vector<std::string> others;
  for (const auto& other : verdict.figures)
    if (&other != &figure && other.judged && other.share > 1)
      others.push_back(fmt::format("{} {:.0f} %", other.name, other.share * percent));
  if (!others.empty()) text += fmt::format(", {}", fmt::join(others, ", "));
  if (!verdict.limit_elsewhere.empty())
    text += fmt::format("; outside of these cycles at its torque limit {}", verdict.limit_elsewhere);
  if (const double share = std::floor(verdict.advised * percent);
      figure.share > 1 && share > 0 && share < percent)
    text += fmt::format("; within 90 % at {:.0f} % of this speed, by a cautious estimate", share);
  return text;
}

std::string text_of(const Alarm& alarm) {
  return fmt::format("{} at {:.6g} s: {}", alarm.source, alarm.at, alarm.text);
}

std::vector<std::string> texts_of(const std::vector<Finding>& findings) {
  std::vector<std::string> texts;
  for (const auto& finding : findings) texts.push_back(finding.text);
  return texts;
}

std::vector<std::string> lines_of(const std::vector<Finding>& findings) {
  std::vector<std::string> lines;
  for (const auto& finding : findings) lines.push_back(to_string(finding));
  return lines;
}

namespace {

Finding cause_among(const std::vector<Finding>& findings) {
  const auto found = std::ranges::find(findings, Finding::Role::cause, &Finding::role);
  return found == findings.end() ? Finding() : *found;
}

}  // namespace

std::string Outcome::cause() const { return cause_among(findings).text; }
std::string Outcome::cause_code() const { return cause_among(findings).code; }

std::vector<Finding> Outcome::warnings() const {
  std::vector<Finding> warnings;
  std::ranges::copy_if(findings, std::back_inserter(warnings),
                       [](const Finding& finding) { return finding.role == Finding::Role::warning; });
  return warnings;
}

void Outcome::add(const std::vector<Finding>& found, Finding::Role role) {
  for (const auto& finding : found) findings.emplace_back(finding).role = role;
}

bool Outcome::passed() const {
  return failure.empty() &&
         std::all_of(checks.begin(), checks.end(), [](const CheckResult& c) { return c.passed; });
}

}  // namespace drycut::sim::record
