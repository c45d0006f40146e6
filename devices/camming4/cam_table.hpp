#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "devices/cam/table.hpp"
#include "devices/camming4/cam.hpp"

namespace drycut::devices::camming4 {

/// A cam of CAMMING4 with what its law needs of the axes, as a file or the device itself holds it.
struct CamSectors {
  static constexpr std::string_view kind = "camming4";
  std::string file;  ///< as the user named it
  // The axes.
  CamSettings settings;      ///< measure, pulse, measurem, pulsem, decpt; 1 Um = 1 bit x4
  std::int32_t unitvel = 1;  ///< 0: speeds per minute, 1: per second
  std::int32_t maxvel = 0;   ///< speed at 10 V [10^decpt Um per unitvel time], 0 = not given
  std::int32_t taccmax = 0;  ///< shortest time from rest to maxvel [1/100 s], 0 = not watched
  std::int32_t tdecmax = 0;  ///< from maxvel to rest
  std::int32_t TCamp = 2;    ///< sampling time [ms]
  CamTravel travel = {};     ///< minpos and maxpos, from where the cam begins [Um]
  // The sectors.
  struct Sector {
    Row row;
    int line = 0;  ///< of the file, 0 = not given
    bool operator==(const Sector& other) const { return row == other.row && (line > 0) == (other.line > 0); }
  };
  std::array<Sector, cam_rows> sectors{};

  [[nodiscard]] const Sector& sector(int number) const {
    return sectors[static_cast<std::size_t>(number - 1)];
  }
  [[nodiscard]] bool has(int number) const {
    return number >= 1 && number <= cam_rows && sector(number).line > 0;
  }
  [[nodiscard]] int count() const;
  void visit(StateArchive& archive);
  bool operator==(const CamSectors&) const = default;
};

}  // namespace drycut::devices::camming4
