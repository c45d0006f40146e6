#include <gtest/gtest.h>

#include "devices/camming4/camming4.hpp"

namespace drycut::devices::camming4 {
namespace {

const DeviceVariable& variable(std::string_view name) {
  return camming4_type.variables[find_symbol(camming4_type, name)->index];
}

TEST(Camming4Table, HasTheCamTableOf128Rows) {
  for (const char* name : {"codeG128", "codeQm128", "codeQs128", "codeQma128", "codeQsa128", "codeM128"})
    EXPECT_TRUE(find_symbol(camming4_type, name)) << name;
  EXPECT_FALSE(find_symbol(camming4_type, "codeG129"));
  EXPECT_EQ(variable("codeG1").size, Size::W);
  EXPECT_EQ(find_symbol(camming4_type, "codeMex")->row, 0);
  EXPECT_EQ(variable("codeMex").rows, 1);
}

}  // namespace
}  // namespace drycut::devices::camming4
