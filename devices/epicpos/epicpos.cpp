#include "devices/epicpos/epicpos.hpp"

#include "devices/epicpos/positioner.hpp"
#include "devices/epicpos/readings.hpp"
#include "devices/epicpos/rows.hpp"

namespace drycut::devices::epicpos {
namespace {

constexpr auto variables = table::joined(table::variables, table::epicpos_variables);

}  // namespace

const DeviceType epicpos_type = {
    "EPICPOS",       "analogue positioner with epicycloidal ramps",
    variables,       table::states,
    table::commands, table::fields,
    table::aliases,  table::readings,
};

std::unique_ptr<Device> make_epicpos(const Resources& resources, Cards& cards) {
  return std::make_unique<Positioner>(epicpos_type, Positioner::Model::epicpos, resources, cards);
}

}  // namespace drycut::devices::epicpos
