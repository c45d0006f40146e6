#pragma once
#include <memory>

#include "devices/epicpos/table.hpp"

namespace drycut::devices::epicpos {

std::unique_ptr<Device> make_epicpos(const Resources& resources, Cards& cards);

}  // namespace drycut::devices::epicpos
