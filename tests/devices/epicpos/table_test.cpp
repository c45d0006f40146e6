#include <gmock/gmock.h>

#include "devices/epicpos/epicpos.hpp"

namespace drycut::devices::epicpos {
namespace {

using eanpos::eanpos_type;

class EpicposTable : public testing::TestWithParam<const DeviceType*> {};
INSTANTIATE_TEST_SUITE_P(Both, EpicposTable, testing::Values(&epicpos_type, &eanpos_type),
                         [](const auto& type) { return std::string(type.param->name); });

const DeviceVariable& variable(const DeviceType& type, std::string_view name) {
  return type.variables[static_cast<std::size_t>(find_symbol(type, name).value().index)];
}

TEST_P(EpicposTable, RangesAreTheManuals) {
  EXPECT_EQ(variable(*GetParam(), "cntratio").min, 374);  // D1: the print's 347 is a slip
  EXPECT_EQ(variable(*GetParam(), "cntratio").max, 400000);
  EXPECT_EQ(variable(*GetParam(), "tinvt").max, 999);
  EXPECT_EQ(variable(*GetParam(), "pgain").max, 32767);
  EXPECT_EQ(variable(*GetParam(), "vout").retention, Retention::zero);
  EXPECT_EQ(variable(*GetParam(), "posit").retention, Retention::retentive);
  EXPECT_EQ(variable(*GetParam(), "integ").max, 1024);
}

TEST(EpicposTables, DifferInTheRampsAlone) {
  const auto has = [](const DeviceType& type, const char* name) {
    return find_symbol(type, name).has_value();
  };
  for (const char* name : {"rtype", "stopt"}) {
    EXPECT_TRUE(has(epicpos_type, name)) << name;
    EXPECT_FALSE(has(eanpos_type, name)) << name;
  }
  EXPECT_TRUE(has(eanpos_type, "ramptype"));
  EXPECT_FALSE(has(epicpos_type, "ramptype"));
  EXPECT_EQ(epicpos_type.variables.size(), 38u);  // 002 1.4.3
  EXPECT_EQ(eanpos_type.variables.size(), 37u);
}

}  // namespace
}  // namespace drycut::devices::epicpos
