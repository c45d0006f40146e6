// The cam of a CAMMING4 as a simulation compares it with its law.
#include <iterator>

#include <fmt/format.h>

#include "devices/axis/speed.hpp"
#include "devices/camming4/camming4.hpp"

namespace drycut::devices::camming4 {

std::optional<CamAxis> Camming4::cam_axis() {
  CamAxis axis;
  axis.kind = "camming4";
  axis.start = [this] { return cam_starts_; };
  axis.moment = [this] { return cam_moment(); };
  axis.table = [this] { return cam_table(); };
  return axis;
}

/// In Um from where master and slave were at the start.
CamMoment Camming4::cam_moment() const {
  if (!state("st_camex")) return {};
  const double slave_bits = axis::bits_per_um(axis_.settings.resolution);
  const auto begin = static_cast<double>(master_.total() - cam_start_.master_count);
  CamMoment moment;
  moment.follows = true;
  moment.master = begin / axis::bits_per_um(master_resolution_);
  moment.set = (axis_.theoretical().minus(cam_start_.slave_bits) - cam_start_.slave_fraction) / slave_bits;
  moment.behind = axis_.error() / slave_bits;
  return moment;
}

std::string Camming4::cam_table() const {
  std::string rows;
  for (int number = 1; number <= cam_rows; ++number) {
    const Row& row = cam_.row(number);
    if (row.codeG != 0)
      fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{}\n", number, row.codeG, row.codeQm,
                     row.codeQs, row.codeQma, row.codeQsa, row.codeM);
  }
  if (rows.empty()) return "";
  auto text = fmt::format(
      "# measure: {}\n# pulse: {}\n# measurem: {}\n# pulsem: {}\n# decpt: {}\n# unitvel: {}\n# TCamp: {}\n",
      value("measure"), value("pulse"), value("measurem"), value("pulsem"), value("decpt"), value("unitvel"),
      period_ms_);
  if (value("maxvel") > 0)
    text += fmt::format("# maxvel: {}\n# taccmax: {}\n# tdecmax: {}\n", value("maxvel"), value("taccmax"),
                        value("tdecmax"));
  return text + "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM\n" + rows;
}

}  // namespace drycut::devices::camming4
