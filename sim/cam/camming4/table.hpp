#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/problem.hpp"
#include "devices/camming4/cam.hpp"
#include "sim/cam/travel.hpp"

namespace drycut::sim {

/// A cam table of CAMMING4 as a CSV file gives it (design §6): comment lines `# key: value` with the device's
/// own names, a header `sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM`, one line a sector.
struct CamTable {
  std::string file;  ///< as the user named it
  // The axes.
  devices::camming4::CamSettings settings;  ///< measure, pulse, measurem, pulsem, decpt; 1 Um = 1 bit x4
  std::int32_t unitvel = 1;                 ///< 0: speeds per minute, 1: per second
  std::int32_t maxvel = 0;                  ///< speed at 10 V [10^decpt Um per unitvel time], 0 = not given
  std::int32_t taccmax = 0;                 ///< shortest time from rest to maxvel [1/100 s], 0 = not watched
  std::int32_t tdecmax = 0;                 ///< from maxvel to rest
  std::int32_t TCamp = 2;                   ///< sampling time [ms]
  CamTravel travel = {};                    ///< minpos and maxpos, from where the cam begins [Um]
  // The sectors.
  struct Sector {
    devices::camming4::Row row;
    int line = 0;  ///< of the file, 0 = not given
  };
  std::array<Sector, devices::camming4::cam_rows> sectors{};

  [[nodiscard]] const Sector& sector(int number) const {
    return sectors[static_cast<std::size_t>(number - 1)];
  }
  [[nodiscard]] bool has(int number) const {
    return number >= 1 && number <= devices::camming4::cam_rows && sector(number).line > 0;
  }
  [[nodiscard]] int count() const;
};

/// Reads the text of a cam table. Every fault becomes a problem with line and column; after 1000 of them the
/// rest is not told.
CamTable read_cam_table(std::string_view text, const std::string& file, Problems& problems);

}  // namespace drycut::sim
