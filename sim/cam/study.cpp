#include "sim/cam/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "base/text.hpp"
#include "sim/cam/camming4/study.hpp"
#include "sim/cam/csv.hpp"
#include "sim/cam/lx3vp/study.hpp"
#include "sim/cam/mc_camin/study.hpp"

namespace drycut::sim {

namespace {

constexpr std::array kinds = {camming4_cams, mc_camin_cams, lx3vp_cams};

/// How many cells of a header are columns of a kind of table, or nearly so.
auto near_columns(const CamKind& kind, std::string_view header) {
  std::vector<std::string> names;
  for (const auto& column : split_cells(kind.header.substr(0, kind.header.find(" ("))))
    names.emplace_back(column.text);
  const auto cells = split_cells(header);
  return std::count_if(cells.begin(), cells.end(), [&](const Cell& cell) {
    return !nearest(std::string(cell.text.substr(0, 40)), names).empty();
  });
}

bool check_no_kind(std::string_view text, const std::string& file, Problems& problems) {
  const auto header = header_line(text);
  const auto before = text.substr(0, static_cast<std::size_t>(header.data() - text.data()));
  const auto line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
  const auto column = static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1;
  problems.push_back(
      {file, line, column, fmt::format("{} is the header of no cam table", in_quotes(trimmed({header}).text)),
       fmt::format(
           "CAMMING4's is {}; LX3VP's is master,slave, or parameter,value below a line "
           "# ecamtbx: K100 (K101, K0, K1); MC_CamIn's is slave, or a0,a1,a2,a3, or master,slave below a "
           "line # interpolation: POLY5_LINE",
           camming4_cams.header)});
  return false;
}

CamStudy study_no_kind(std::string_view text, const std::string& file, const CamRequest& /*request*/,
                       Problems& problems) {
  check_no_kind(text, file, problems);
  return {};
}

IdealCam ideal_of_no_kind(std::string_view /*text*/, MasterRange /*range*/) { return {}; }

bool owns_nothing(std::string_view /*text*/) { return false; }

/// Takes what no kind knows, to tell what all of them want.
constexpr CamKind no_kind = {"", "", owns_nothing, check_no_kind, study_no_kind, ideal_of_no_kind};

}  // namespace

std::span<const CamKind> cam_kinds() { return kinds; }

const CamKind& cam_kind(std::string_view name, std::string_view text) {
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const CamKind& kind) {
    return name.empty() ? kind.owns(text) : kind.name == name;
  });
  if (found != kinds.end()) return *found;
  const auto header = header_line(text);
  const bool numbers = !header.empty() && std::isdigit(static_cast<unsigned char>(header.front())) != 0;
  if (!name.empty() || header.empty() || numbers) return kinds.front();
  const auto near = std::max_element(kinds.begin(), kinds.end(), [&](const CamKind& a, const CamKind& b) {
    return near_columns(a, header) < near_columns(b, header);
  });
  return near_columns(*near, header) == 0 ? no_kind : *near;
}

void take(CamStudy& study, CamDrawing drawing) {
  study.plot = std::move(drawing.plot);
  study.peaks = std::move(drawing.peaks);
}

std::string cam_report(const CamStudy& study) {
  return study.text.heading + '\n' + study.text.sections + '\n' + findings_text(study.findings) +
         study.text.totals;
}

void check_positions(const std::vector<double>& at, MasterRange range, std::string_view unit,
                     Problems& problems) {
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
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    return line.substr(begin);
  }
  return {};
}

}  // namespace drycut::sim
