#include "base/text.hpp"

#include <gmock/gmock.h>

namespace drycut {
namespace {

TEST(Text, TrimmedIsAPieceOfTheText) {
  const std::string_view text = " \t posit = 5\r";
  EXPECT_EQ(trimmed(text), "posit = 5");
  EXPECT_EQ(trimmed("posit"), "posit");
  // Places are told by where the piece lies in its line, even if nothing is left.
  const std::string_view blank = "  \t";
  EXPECT_EQ(trimmed(blank), "");
  EXPECT_EQ(trimmed(blank).data(), blank.data());
}

TEST(Text, AByteOrderMarkIsTakenOffOnce) {
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBF"
                                    "a"),
            "a");
  EXPECT_EQ(without_byte_order_mark("a"), "a");
  EXPECT_EQ(without_byte_order_mark("\xEF\xBB\xBF\xEF\xBB\xBF"), "\xEF\xBB\xBF");
}

TEST(Text, CellsAreQuotedWhereTheyHaveTo) {
  EXPECT_EQ(csv_cell("knife.angle [deg]"), "knife.angle [deg]");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("5\" pipe"), "\"5\"\" pipe\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
}

TEST(Text, XmlSaysItsSigns) {
  EXPECT_EQ(xml_text("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
}

TEST(Text, QuotesShowBytesAndCutWhatIsLong) {
  EXPECT_EQ(in_quotes("posit"), "'posit'");
  EXPECT_EQ(in_quotes(std::string_view("1\0", 2)), "'1\\x00'");
  EXPECT_EQ(in_quotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, TheNearestNameIsSuggestedElseWhatThereIs) {
  const std::vector<std::string> names = {"posit", "vel"};
  EXPECT_EQ(did_you_mean("posti", names), "did you mean posit?");
  EXPECT_EQ(did_you_mean("torque", names), "known: posit, vel");
  EXPECT_EQ(did_you_mean("torque", {}), "nothing can stand here");
  EXPECT_EQ(did_you_mean("torque", names, "see the table"), "see the table");
  EXPECT_EQ(suggestion("posti", names, "see the table"), "did you mean 'posit'?");
  EXPECT_EQ(suggestion(std::string(65, 'x'), {std::string(66, 'x')}, "see the table"), "see the table");
}

TEST(Text, WordsHaveTheirPlaces) {
  const Words words = split_words(",a  bc,,\xC3\xA9 d", {3, 10}, " ,");
  ASSERT_EQ(words.size(), 4U);
  EXPECT_EQ(words[1].text, "bc");
  for (const auto& [word, column] : {std::pair{0, 11}, {1, 14}, {2, 18}, {3, 21}}) {
    EXPECT_EQ(words[static_cast<std::size_t>(word)].place.line, 3);
    EXPECT_EQ(words[static_cast<std::size_t>(word)].place.column, column);
  }
  EXPECT_TRUE(split_words(" , ", {1, 1}, " ,").empty());
  EXPECT_TRUE(split_words("", {1, 1}, " ,").empty());
}

TEST(Text, ANumberIsAllOfItsText) {
  EXPECT_EQ(parsed<int>("-12"), -12);
  EXPECT_EQ(parsed<unsigned>("1F", 16), 31U);
  EXPECT_EQ(parsed<double>("1.5e3"), 1500);
  for (const char* none : {"", "-", "12 ", " 12", "+12", "1.5", "2147483648"})
    EXPECT_EQ(parsed<int>(none), std::nullopt) << none;
}

}  // namespace
}  // namespace drycut
