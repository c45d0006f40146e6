#include "devices/lx3vp/ecam_table.hpp"

#include <tuple>

#include "base/state_archive.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

void EcamTable::complete() {
  if (max_frequency == 0) max_frequency = max_frequency_hz;
  if (!is_made()) return;
  made = make_table(*type, saw, s_curve);
  rows = made.rows;
  if (is_s_curve()) {
    if (time_axis == 0) time_axis = 1;  // its master is time
  } else if (!max_ratio) {
    max_ratio = static_cast<double>(saw.max_ratio);
  }
}

void EcamTable::visit(StateArchive& archive) {
  STATE(archive, file, max_frequency, time_axis, max_ratio, travel, cyclic, rows, lines, type, saw, s_curve);
  if (archive.restores()) complete();
}

bool operator==(const EcamTable& a, const EcamTable& b) {
  const auto given = [](const EcamTable& table) {
    return std::tie(table.max_frequency, table.time_axis, table.max_ratio, table.travel, table.cyclic,
                    table.rows, table.type, table.saw, table.s_curve);
  };
  return given(a) == given(b);
}

}  // namespace drycut::devices::lx3vp
