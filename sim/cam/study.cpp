#include "sim/cam/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/cam/camming4/study.hpp"
#include "sim/cam/lx3vp/study.hpp"

namespace drycut::sim {

namespace {

constexpr std::array kinds = {camming4_cams, lx3vp_cams};

}  // namespace

std::span<const CamKind> cam_kinds() { return kinds; }

const CamKind& cam_kind(std::string_view name, std::string_view text) {
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const CamKind& kind) {
    return name.empty() ? kind.owns(text) : kind.name == name;
  });
  return found == kinds.end() ? kinds.front() : *found;
}

std::string cam_report(const CamStudy& study) {
  return study.text.heading + '\n' + study.text.sections + '\n' + findings_text(study.findings) +
         study.text.totals;
}

void check_positions(const std::vector<double>& at, MasterRange range, std::string_view unit,
                     devices::Problems& problems) {
  for (const double position : at) {
    if (position >= range.first && position <= range.last) continue;
    problems.push_back({"--at", 1, 1, fmt::format("the cam has no master position {}", position),
                        fmt::format("give positions from {} to {} {}", range.first, range.last, unit)});
  }
}

std::string_view header_line(std::string_view text) {
  while (!text.empty()) {
    auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const auto begin = line.find_first_not_of(" \t\r\xEF\xBB\xBF");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    return line.substr(begin);
  }
  return {};
}

}  // namespace drycut::sim
