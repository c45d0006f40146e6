#include "devices/cards.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace drycut::devices {
namespace {

TEST(Address, IsReadInAnyCaseAndSpelling) {
  EXPECT_EQ(parse_address("2.CNT01"), (Address{Kind::counter, 2, 1}));
  EXPECT_EQ(parse_address("1.cnt1"), (Address{Kind::counter, 1, 1}));
  EXPECT_EQ(parse_address("2.INP12"), (Address{Kind::input, 2, 12}));
  EXPECT_EQ(parse_address("2.IN01"), (Address{Kind::input, 2, 1}));
  EXPECT_EQ(parse_address("2.OUT3"), (Address{Kind::output, 2, 3}));
  EXPECT_EQ(parse_address("3.an01"), (Address{Kind::analogue, 3, 1}));
  EXPECT_EQ(parse_address("INT5"), (Address{Kind::interrupt, 0, 5}));
}

TEST(Address, IsRefusedIfItIsNone) {
  const std::vector<std::string> wrong = {"",
                                          "2",
                                          "2.",
                                          "2.CNT",
                                          "CNT01",
                                          "X.X",
                                          "2.CNT0",
                                          "0.OUT1",
                                          "2.FOO01",
                                          "2.INT5",
                                          "INT9",
                                          "INT0",
                                          "2,OUT1",
                                          "2.OUT1x",
                                          " 2.OUT1",
                                          "2.OUT1 ",
                                          "2.OUT99999999",
                                          "-2.OUT1",
                                          "2..OUT1",
                                          "9999999999.OUT1"};
  for (const std::string& text : wrong) EXPECT_FALSE(parse_address(text)) << text;
}

TEST(Address, IsPrintedAsItIsRead) {
  for (const std::string text : {"2.CNT01", "2.INP12", "3.OUT03", "2.AN01", "INT5"})
    EXPECT_EQ(to_string(parse_address(text).value()), text);
}

TEST(Kind, HasANameForMessages) {
  EXPECT_EQ(name_of(Kind::counter), "counter");
  EXPECT_EQ(name_of(Kind::input), "digital input");
  EXPECT_EQ(name_of(Kind::output), "digital output");
  EXPECT_EQ(name_of(Kind::analogue), "analogue output");
  EXPECT_EQ(name_of(Kind::interrupt), "interrupt line");
}

TEST(Cards, ReferencesSurviveMoreTerminals) {
  Cards cards;
  DigitalOutput& first = cards.outputs[{Kind::output, 2, 50}];
  for (int i = 1; i <= 200; ++i) cards.outputs[{Kind::output, 2, i}];
  first.level = true;
  EXPECT_TRUE(cards.outputs.at({Kind::output, 2, 50}).level);
}

}  // namespace
}  // namespace drycut::devices
