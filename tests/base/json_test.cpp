#include "base/json.hpp"

#include <gtest/gtest.h>

namespace drycut {
namespace {

TEST(JsonTexts, ThereAndBack) {
  const Json json = {{"z", 1}, {"a", {0.5, "two"}}};
  EXPECT_EQ(json_text(json), R"({"z":1,"a":[0.5,"two"]})");
  EXPECT_EQ(json_from(json_text(json, 2)), json);
}

TEST(JsonTexts, WhatIsNoUtf8IsReplaced) { EXPECT_EQ(json_text("a\xff\x62"), "\"a\xef\xbf\xbd\x62\""); }

TEST(JsonTexts, WhatIsNoJsonThrowsOrIsNull) {
  for (const auto* text : {"", "{\"a\":", "{} {}"}) {
    EXPECT_THROW(json_from(text), Json::parse_error) << text;
    EXPECT_TRUE(json_or_null(text).is_null()) << text;
  }
}

}  // namespace
}  // namespace drycut
