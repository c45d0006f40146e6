#include "base/table.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace drycut {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Table cuts() {
  Table table({{"speed", "speed", "m/min"}, {"verdict", "verdict"}, {"accuracy", "accuracy", "mm", 4}});
  table.add({60.0, "passed", 0.0531239});
  table.add({120.1234567, "failed, late", none});
  table.add({180.0});
  return table;
}

TEST(Table, IsACsvFileWithEachColumnsDigits) {
  EXPECT_EQ(cuts().csv(),
            "speed [m/min],verdict,accuracy [mm]\n"
            "60,passed,0.05312\n"
            "120.123457,\"failed, late\",\n"
            "180,,\n");
}

TEST(Table, IsReadInSixDigits) {
  const auto table = cuts();
  EXPECT_EQ(table.shown(1), (std::vector<std::string>{"120.123", "failed, late", ""}));
  EXPECT_EQ(table.text(0),
            "  speed [m/min]  verdict       accuracy [mm]\n"
            "             60  passed        0.0531239\n"
            "        120.123  failed, late\n"
            "            180\n");
}

TEST(Table, FindsColumnsByKeyWhateverTheyAreCalled) {
  Table table({{"a", "b"}, {"b", "a"}});
  EXPECT_EQ(table.find("b"), 1U);
  EXPECT_FALSE(table.find("c"));
}

TEST(Table, IsJsonByItsKeys) {
  EXPECT_EQ(cuts().json()[1].dump(), R"({"speed":120.1234567,"verdict":"failed, late","accuracy":null})");
}

TEST(Table, IsMarkdown) {
  EXPECT_NE(cuts().markdown().find("| 60 | passed | 0.0531239 |"), std::string::npos);
}

TEST(Table, TakesAnotherUnderTheColumnsOfBoth) {
  Table table({{"x", "x", "mm"}, {"y", "y"}});
  table.add({1.0, 2.0});
  Table other({{"y", "y"}, {"x", "x", "m"}, {"z", "z"}});
  other.add({3.0, 4.0, "end"});
  table.append(other);
  EXPECT_EQ(table.csv(),
            "x [mm],y,x [m],z\n"
            "1,2,,\n"
            ",3,4,end\n");
}

}  // namespace
}  // namespace drycut
