// What can be read and shown as text: every kind of byte that cannot, with its place.
#include "base/plain_text.hpp"

#include <gmock/gmock.h>

namespace drycut {
namespace {

std::string told(std::string_view text) {
  const auto fault = text_fault(text);
  return fault ? std::to_string(fault->line) + ":" + std::to_string(fault->column) + ": " + fault->what : "";
}

TEST(PlainText, Utf8IsTakenToTheEndsOfItsRanges) {
  for (const auto* text : {"\x7E", "\xC2\xA0", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                           "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF", "\t\r\n"})
    EXPECT_EQ(told(text), "") << printable(text);
}

TEST(PlainText, AShellTakesAWordAsItWas) {
  EXPECT_EQ(shell_word("cams/best-2.csv"), "cams/best-2.csv");
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("my cam.csv"), "'my cam.csv'");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
}

TEST(PlainText, WhatIsNoUtf8IsTold) {
  EXPECT_EQ(told("\x80"), "1:1: byte 0x80 is no text") << "a rest alone";
  EXPECT_EQ(told("\xC1\xBF"), "1:1: byte 0xc1 is no text") << "longer than it needs";
  EXPECT_EQ(told("\xE0\x9F\xBF"), "1:1: byte 0xe0 is no text");
  EXPECT_EQ(told("\xF0\x8F\xBF\xBF"), "1:1: byte 0xf0 is no text");
  EXPECT_EQ(told("\xED\xA0\x80"), "1:1: byte 0xed is no text") << "a lone surrogate";
  EXPECT_EQ(told("\xF4\x90\x80\x80"), "1:1: byte 0xf4 is no text") << "beyond U+10FFFF";
  EXPECT_EQ(told("\xF5"), "1:1: byte 0xf5 is no text");
  EXPECT_EQ(told("\xE2\x82"), "1:1: byte 0xe2 is no text") << "cut short";
}

TEST(PlainText, ThePlaceCountsLinesAndCharacters) {
  EXPECT_EQ(told("a\r\n\xC3\xA4\xE2\x82\xAC\xFF"), "2:3: byte 0xff is no text");
  EXPECT_EQ(told(std::string("ab\0", 3)), "1:3: byte 0x00 is no text");
  EXPECT_EQ(told("a\x1B[31m"), "1:2: byte 0x1b is no text");
  EXPECT_EQ(told("a\x7F"), "1:2: byte 0x7f is no text");
  EXPECT_EQ(told("a\xC2\x85"), "1:2: U+0085 is no text");
}

TEST(PlainText, ANameOnATerminalDoesNothingButBeRead) {
  EXPECT_EQ(printable("a\x1B[31m \xC2\x9B\xFF\n\tb"), "a\\x1B[31m \\xC2\\x9B\\xFF\\x0A\\x09b");
  EXPECT_EQ(printable("L\xC3\xA4nge \xC2\xA0"), "L\xC3\xA4nge \xC2\xA0");
}

}  // namespace
}  // namespace drycut
