#pragma once
#include <memory>

#include "devices/epicpos/table.hpp"

namespace drycut::devices::epicpos {

std::unique_ptr<Device> make_epicpos(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::epicpos

namespace drycut::devices::eanpos {
namespace table {

inline constexpr auto variables = joined(epicpos::table::variables, epicpos::table::eanpos_variables);

inline constexpr std::array own_readings = {
    ManualReading{"", "has all of EPICPOS (002) but rtype and stopt, and its readings",
                  "000 1.5 declares the device; its own manual is not to be had"},
    ManualReading{"ramptype", "as CAMMING4's (000 1.9.2): 0 trapezoidal, 1 epicycloidal",
                  "000 1.5 declares the device; its own manual is not to be had"},
};
inline constexpr auto readings = joined(own_readings, epicpos::table::readings);

}  // namespace table

/// EANPOS: analogue positioner with trapezoidal ramps, or epicycloidal ones by `ramptype` (spec qem.md 7).
/// Its own tables are not to be had: it is EPICPOS without rtype and stopt (D17). With its counter on slot 1
/// and no other terminal it is the simulated master of CAMMING4 (000 1.5).
inline constexpr DeviceType eanpos_type = {
    "EANPOS",
    "analogue positioner with trapezoidal or epicycloidal ramps; simulated master on a counter of slot 1",
    table::variables,
    epicpos::table::states,
    epicpos::table::commands,
    epicpos::table::fields,
    epicpos::table::aliases,
    table::readings,
};

std::unique_ptr<Device> make_eanpos(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::eanpos
