#pragma once
#include <memory>

#include "devices/oopos2/table.hpp"

namespace drycut::devices::oopos2 {

std::unique_ptr<Device> make_oopos2(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::oopos2
