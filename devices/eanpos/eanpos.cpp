#include "devices/eanpos/eanpos.hpp"

#include <array>

#include "devices/epicpos/positioner.hpp"
#include "devices/epicpos/readings.hpp"
#include "devices/epicpos/rows.hpp"

namespace drycut::devices::eanpos {
namespace {

namespace table = epicpos::table;

constexpr auto variables = table::joined(table::variables, table::eanpos_variables);

constexpr std::array own_readings = {
    Reading{"", "has all of EPICPOS (002) but rtype and stopt, and its readings",
            "000 1.5 declares the device; its own manual is not to be had"},
    Reading{"ramptype", "as CAMMING4's (000 1.9.2): 0 trapezoidal, 1 epicycloidal",
            "000 1.5 declares the device; its own manual is not to be had"},
};
constexpr auto readings = table::joined(own_readings, table::readings);

}  // namespace

const DeviceType eanpos_type = {
    "EANPOS",
    "analogue positioner with trapezoidal or epicycloidal ramps; simulated master on a counter of slot 1",
    variables,
    table::states,
    table::commands,
    table::fields,
    table::aliases,
    readings,
};

std::unique_ptr<Device> make_eanpos(const Resources& resources, Cards& cards) {
  return std::make_unique<epicpos::Positioner>(eanpos_type, epicpos::Positioner::Model::eanpos, resources,
                                               cards);
}

}  // namespace drycut::devices::eanpos
