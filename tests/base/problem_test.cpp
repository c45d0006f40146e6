#include "base/problem.hpp"

#include <gtest/gtest.h>

namespace drycut {
namespace {

TEST(Problem, IsPrintedWithItsPlaceAndRemedy) {
  EXPECT_EQ(to_string(Problem{"cnf.unknown-name"_code, "a.cnf", 3, 7, "unknown type 'Q'", "the type is F"}),
            "a.cnf:3:7: unknown type 'Q'; the type is F [cnf.unknown-name]");
}

TEST(Problem, WithoutRemedyHasNoSemicolon) {
  EXPECT_EQ(to_string(Problem{"cnf.syntax"_code, "a", 1, 1, "empty", ""}), "a:1:1: empty [cnf.syntax]");
}

TEST(Nearest, FindsSlipsOfTheFinger) {
  const std::vector<std::string> names = {"posit", "setpos", "st_still", "feedfw"};
  EXPECT_EQ(nearest("posti", names), "posit");        // two letters swapped
  EXPECT_EQ(nearest("setpso", names), "setpos");      // the same at the end
  EXPECT_EQ(nearest("st still", names), "st_still");  // the underscore lost in print
  EXPECT_EQ(nearest("feedf", names), "feedfw");       // one missing
  EXPECT_EQ(nearest("possit", names), "posit");       // one too many
  EXPECT_EQ(nearest("FEEDFW", names), "feedfw");      // case is no difference
}

TEST(Nearest, SuggestsNothingForAnotherWord) {
  EXPECT_EQ(nearest("acceleration", {"posit", "setpos"}), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("posit", {}), "");
  EXPECT_EQ(nearest("", {"posit", ""}), "");
}

TEST(Nearest, PrefersTheFewestEditsThenTheFirst) {
  EXPECT_EQ(nearest("codeQ1", {"codeQma1", "codeQs1", "codeQm1"}), "codeQs1");
}

}  // namespace
}  // namespace drycut
