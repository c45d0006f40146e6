#include "devices/eanpos/eanpos.hpp"

#include "devices/epicpos/positioner.hpp"
#include "devices/epicpos/rows.hpp"

namespace drycut::devices::eanpos {
namespace {

namespace table = epicpos::table;

constexpr auto variables = table::joined(table::variables, table::eanpos_variables);

}  // namespace

const DeviceType eanpos_type = {
    "EANPOS",
    "analogue positioner with trapezoidal or epicycloidal ramps; simulated master on a counter of slot 1",
    variables,
    table::states,
    table::commands,
    table::fields,
    table::aliases,
};

std::unique_ptr<Device> make_eanpos(const Resources& resources, Cards& cards) {
  return std::make_unique<epicpos::Positioner>(eanpos_type, epicpos::Positioner::Model::eanpos, resources,
                                               cards);
}

}  // namespace drycut::devices::eanpos
