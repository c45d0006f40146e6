#include "devices/oopos2/oopos2.hpp"

#include "devices/oopos2/on_off_positioner.hpp"
#include "devices/oopos2/readings.hpp"
#include "devices/oopos2/table.hpp"

namespace drycut::devices::oopos2 {

const DeviceType oopos2_type = {
    "OOPOS2",         "on/off positioner: forward, backward, slowdown and brake outputs by the position",
    table::variables, table::states,
    table::commands,  table::fields,
    table::aliases,   table::readings,
};

std::unique_ptr<Device> make_oopos2(const Resources& resources, Cards& cards) {
  return std::make_unique<OnOffPositioner>(resources, cards);
}

}  // namespace drycut::devices::oopos2
