#include <type_traits>

#include "devices/camming4/table.hpp"
#include "devices/oopos2/table.hpp"

namespace drycut::devices {
namespace {

template <const DeviceType& type>
concept NamesPgain = requires {
  typename std::integral_constant<int, NamedRow<type, &DeviceType::variables>("pgain")>;
};

// A name compiles for a device whose table has it, and for no other.
static_assert(NamesPgain<camming4::camming4_type>);
static_assert(!NamesPgain<oopos2::oopos2_type>);

constexpr camming4::VariableRow row = "pgain";
static_assert(camming4::camming4_type.variables[row].name == "pgain");
static_assert(row == "pgain" && row != "feedfw");

}  // namespace
}  // namespace drycut::devices
