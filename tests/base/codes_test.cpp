
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/problem.hpp"

namespace drycut {
namespace {

TEST(Codes, AreKebabWordsOfARoomAndSayAllThree) {
  for (const auto& [code, text, cause, cure] : code_rows) {
    const auto dot = code.find('.');
    ASSERT_NE(dot, std::string_view::npos) << code;
    EXPECT_EQ(code.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-", dot + 1),
              std::string_view::npos)
        << code;
    EXPECT_FALSE(text.empty() || cause.empty() || cure.empty()) << code;
    EXPECT_NE(text.back(), '.') << code << ": help puts it";
  }
}

TEST(Codes, StandAtTheEndOfALine) {
  const Problem problem{"scenario.unknown-key"_code, "a.yaml", 3, 7, "unknown key 'x'", "did you mean y?"};
  EXPECT_EQ(to_string(problem), "a.yaml:3:7: unknown key 'x'; did you mean y? [scenario.unknown-key]");
  EXPECT_EQ(to_string(Finding("loop.axis-hunts"_code, "it hunts")), "it hunts [loop.axis-hunts]");
}

TEST(Codes, AreReadBack) {
  EXPECT_EQ(CodeTable::named("cam.jump"), "cam.jump"_code);
  EXPECT_FALSE(CodeTable::named("cam.jumps"));
  EXPECT_FALSE(CodeTable::named(""));
}

}  // namespace
}  // namespace drycut
