#include "sim/cams/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace drycut::sim::cams {

std::string grade_text(const CamFinding& finding) {
  const auto numbered = [&](const char* grade) {
    return finding.number == 0 ? std::string(grade) : fmt::format("{} {}", grade, finding.number);
  };
  switch (finding.grade) {
    case CamFinding::Grade::error:
      return numbered("error");
    case CamFinding::Grade::warning:
      return numbered("warning");
    case CamFinding::Grade::limit:
      return "limit";
    case CamFinding::Grade::caution:
      return "caution";
    case CamFinding::Grade::remark:
      return "remark";
  }
  return "";
}

std::string sentence(const CamFinding& finding) {
  auto text = finding.where.empty() ? "" : finding.where + ": ";
  text += grade_text(finding) + ": " + finding.text;
  if (!finding.remedy.text.empty()) text += "; " + finding.remedy.text;
  return text;
}

std::string to_string(const CamFinding& finding) {
  return fmt::format("{} [{}]", sentence(finding), finding.kind.text());
}

bool is_unsound(const std::vector<CamFinding>& findings, bool strict) {
  return std::any_of(findings.begin(), findings.end(), [&](const CamFinding& finding) {
    return finding.grade == CamFinding::Grade::error || finding.grade == CamFinding::Grade::limit ||
           (strict && finding.grade != CamFinding::Grade::remark);
  });
}

std::string findings_text(const std::vector<CamFinding>& findings) {
  if (findings.empty()) return "no finding\n";
  std::string text;
  for (const auto& finding : findings) text += to_string(finding) + '\n';
  return text;
}

std::string number_text(double number, int digits) {
  auto text = fmt::format("{:.{}g}", number, digits);
  if (text == "-0") text = "0";
  return text;
}

namespace {

constexpr int digits_told = 6;
// Finer than `within`: limits grow with up to the third power of a speed.
constexpr double same = 1 + 1e-12;

double told(double value) { return std::strtod(number(value).c_str(), nullptr); }
/// One in the last digit told.
double last_digit(double value) { return std::pow(10.0, std::floor(std::log10(value)) + 1 - digits_told); }

}  // namespace

std::string number(double value) { return number_text(value, digits_told); }

std::string number_below(double value) {
  return number(told(value) <= value * same ? value : told(value) - last_digit(value));
}

std::string number_above(double value) {
  return number(told(value) * same >= value ? value : told(value) + last_digit(value));
}

CamRemedy slower_master(const std::string& words, double most, const std::string& unit) {
  const auto speed = number_below(most);
  return {fmt::format("{}run the master at {} {} at most", words, speed, unit),
          {{0, "master speed", std::strtod(speed.c_str(), nullptr)}}};
}

std::string whole(double value) { return fmt::format("{:.0f}", value); }

}  // namespace drycut::sim::cams
