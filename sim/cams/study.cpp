#include "sim/cams/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <type_traits>

#include "base/text.hpp"
#include "devices/camming4/cam_table.hpp"
#include "devices/lx3vp/ecam_table.hpp"
#include "devices/plcopen/tab_file.hpp"
#include "sim/cams/kinds.hpp"

namespace drycut::sim::cams {

namespace {

bool owns_camming4(std::string_view text) { return header_line(text).starts_with("sector"); }

bool owns_mc_camin(std::string_view text) {
  const auto header = header_line(text).substr(0, header_line(text).find_first_of("\r\n"));
  if (header.starts_with("slave") || header.starts_with("a0")) return true;
  if (header.find('=') != std::string_view::npos) return true;  // of a .tab file
  const auto above = text.substr(0, static_cast<std::size_t>(header.data() - text.data()));
  return header.starts_with("master") && above.find("# interpolation") != std::string_view::npos;
}

bool owns_lx3vp(std::string_view text) {
  const auto header = header_line(text);
  return header.starts_with("master") || header.starts_with("parameter");
}

/// The row of a kind by what it has of its own for its tables.
template <auto read_table>
constexpr CamKind kind_of(std::string_view header, bool (*owns)(std::string_view),
                          std::vector<CamKey> (*keys)(), std::vector<CamKey> (*columns)()) {
  using Table = std::invoke_result_t<decltype(read_table), std::string_view, std::string, Problems&>;
  return {
      Table::kind,
      header,
      owns,
      [](std::string_view text, const std::string& file, Problems& problems) {
        return devices::CamTable(read_table(text, file, problems));
      },
      keys,
      columns,
      [](const devices::CamTable& table, const CamRequest& request, Problems& problems) {
        return study_of(table.as<Table>(), request, problems);
      },
      [](const devices::CamTable& table, MasterRange range) { return ideal_of(table.as<Table>(), range); },
      [](devices::CamTable& table, const std::string& file) { return file_of(table.as<Table>(), file); }};
}

/// Sectors of CAMMING4 (000), run by the device's own cam engine.
constexpr CamKind camming4_cams = kind_of<read_camming4>("sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM",
                                                         owns_camming4, camming4_keys, camming4_columns);
/// Cam tables of the ISG kernel's MC_CamIn (004): its .tab files, or CSV.
constexpr CamKind mc_camin_cams = kind_of<read_mc_camin>(
    "slave (or a0,a1,a2,a3, or master,slave below # interpolation: POLY5_LINE; or a .tab file)",
    owns_mc_camin, mc_camin_keys, mc_camin_columns);
/// Tables of the LX3VP's electronic cam (003), given or made by its own ECAMTBX.
constexpr CamKind lx3vp_cams = kind_of<read_lx3vp>("master,slave (or # ecamtbx: K100 and parameter,value)",
                                                   owns_lx3vp, lx3vp_keys, lx3vp_columns);
/// In the order of asking whose a text is.
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

devices::CamTable read_no_kind(std::string_view text, const std::string& file, Problems& problems) {
  const auto header = header_line(text);
  const auto before = text.substr(0, static_cast<std::size_t>(header.data() - text.data()));
  const auto line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
  const auto column = static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1;
  problems.push_back(
      {"cam.unknown-key"_code, file, line, column,
       fmt::format("{} is the header of no cam table", in_quotes(trimmed({header}).text)),
       fmt::format(
           "CAMMING4's is {}; LX3VP's is master,slave, or parameter,value below a line "
           "# ecamtbx: K100 (K101, K0, K1); MC_CamIn's is slave, or a0,a1,a2,a3, or master,slave below a "
           "line # interpolation: POLY5_LINE",
           camming4_cams.header)});
  return {};
}

bool owns_nothing(std::string_view /*text*/) { return false; }

/// Takes what no kind knows, to tell what all of them want.
constexpr CamKind no_kind = {"", "", owns_nothing, read_no_kind};

void check_positions(const std::vector<double>& at, const CamStudy& study, Problems& problems) {
  const double first = study.course.first_master;
  const double last = first + study.course.master_total();
  for (const double position : at) {
    if (position >= first && position <= last) continue;
    problems.push_back({"cam.out-of-range"_code, "--at", 1, 1,
                        fmt::format("the cam has no master position {}", position),
                        fmt::format("give positions from {} to {} {}", first, last, study.master_unit)});
  }
}

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
  const CamKind* nearest_kind = &no_kind;
  std::ptrdiff_t most = 0;
  for (const auto& kind : kinds) {
    const auto columns = near_columns(kind, header);
    if (columns > most) nearest_kind = &kind;
    most = std::max(most, columns);
  }
  return *nearest_kind;
}

devices::CamTable read_cam(std::string_view device, std::string_view text, const std::string& file,
                           Problems& problems) {
  const auto& wanted = cam_kind(device, text);
  const auto owner = std::ranges::find_if(kinds, [&](const CamKind& kind) { return kind.owns(text); });
  // All its keys and columns would be unknown.
  if (owner != kinds.end() && owner->name != wanted.name && !wanted.owns(text) &&
      near_columns(wanted, header_line(text)) == 0) {
    problems.push_back({"file.other-kind"_code, file, 1, 1,
                        fmt::format("this is a cam of {}, not of {}", owner->name, wanted.name),
                        fmt::format("leave --device out, or write --device {}", owner->name)});
    return {};
  }
  return wanted.read(text, file, problems);
}

CamStudy study_cam(const devices::CamTable& table, const CamRequest& request, Problems& problems) {
  auto study = cam_kind(table.kind(), "").study(table, request, problems);
  const auto& course = study.course;
  // A cam of sectors has its beginning, whatever stops it there.
  if (!course.runs() && course.passes == 0) return study;
  check_positions(request.at, study, problems);
  if (!problems.empty()) return {};
  study.points = request.at.empty() ? sample_cam(course) : sample_cam_at(course, request.at);
  auto drawing = motion_plot(course, study.zones, study.motion, request.plot_name);
  study.plot = std::move(drawing.plot);
  study.peaks = std::move(drawing.peaks);
  return study;
}

IdealCam ideal_cam(const devices::CamTable& table, MasterRange range) {
  return cam_kind(table.kind(), "").ideal(table, range);
}

bool gives_master_speed(const devices::CamTable& table) {
  return table.kind() == EcamTable::kind && table.as<EcamTable>().time_axis > 0;
}

std::string cam_file(devices::CamTable& table, const std::string& file) {
  return cam_kind(table.kind(), "").file(table, file);
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

}  // namespace drycut::sim::cams
