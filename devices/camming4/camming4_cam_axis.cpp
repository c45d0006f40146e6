// The cam of a CAMMING4 as a simulation compares it with its law.
#include <algorithm>

#include "base/state_archive.hpp"
#include "devices/axis/position.hpp"
#include "devices/camming4/cam_table.hpp"
#include "devices/camming4/camming4.hpp"
#include "devices/controller.hpp"

namespace drycut::devices::camming4 {

std::optional<CamAxis> Camming4::cam_axis() {
  CamAxis axis;
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

std::shared_ptr<const devices::CamTable> Camming4::cam_table() const {
  CamSectors table;
  for (int number = 1; number <= cam_rows; ++number)
    if (const Row& row = cam_.row(number); row.codeG != 0)
      table.sectors[static_cast<std::size_t>(number - 1)] = {row, number};
  if (table.count() == 0) return nullptr;
  table.settings = {{value("measurem"), value("pulsem")}, {value("measure"), value("pulse")}, value("decpt")};
  table.unitvel = value("unitvel");
  table.TCamp = period_ms_;
  if (value("maxvel") > 0) {
    table.maxvel = value("maxvel");
    table.taccmax = value("taccmax");
    table.tdecmax = value("tdecmax");
  }
  return std::make_shared<const devices::CamTable>(std::move(table));
}

void CamSectors::visit(StateArchive& archive) {
  STATE(archive, file, settings, unitvel, maxvel, taccmax, tdecmax, TCamp, travel);
  archive.each("sectors", sectors, [&](Sector& sector) { STATE(archive, sector.row, sector.line); });
}

int CamSectors::count() const {
  return static_cast<int>(
      std::count_if(sectors.begin(), sectors.end(), [](const Sector& s) { return s.line > 0; }));
}

}  // namespace drycut::devices::camming4
