// The reference of scenario files and cam tables: what can be said is in it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/cams/study.hpp"
#include "sim/cli/pages.hpp"
#include "sim/studies/compare/scene.hpp"

namespace drycut::sim::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const Page& page) {
  std::string text;
  for (const auto& sheet : page.sheets) text += sheet.markdown();
  std::erase(text, '\\');  // Markdown's own
  return text;
}

/// Every key that the schema knows must have a row. Parameters of plants and axes have pages of their own.
void expect_rows(const json& schema, const std::string& text) {
  if (schema.is_array())
    for (const auto& one : schema) expect_rows(one, text);
  if (!schema.is_object() || schema.contains("patternProperties")) return;
  for (const auto& [key, value] : schema.items()) {
    if (key == "properties") {
      for (const auto& [name, inside] : value.items()) EXPECT_THAT(text, HasSubstr("| " + name + " |"));
    }
    expect_rows(value, text);
  }
}

TEST(Reference, HasEveryKeyOfAScenario) {
  const auto pages = scenario_pages();
  const auto schema = json::parse(studies::json_schema());
  ASSERT_EQ(pages.size(), 3u);
  auto text = text_of(pages[0]);
  // A controller's kinds are sections.
  for (const auto* kind : {"qmove", "lx3vp", "plcopen"}) {
    EXPECT_THAT(text, HasSubstr(std::string("## controller.") + kind + "\n"));
    text += std::string("| ") + kind + " |";
  }
  expect_rows(schema.at("else").at("else"), text);
  expect_rows(schema.at("then"), text_of(pages[1]));
  expect_rows(schema.at("else").at("then"), text_of(pages[2]));
}

TEST(Reference, SaysWhatAValueMayBeAndItsDefault) {
  const auto text = text_of(scenario_pages()[0]);
  const std::vector<std::string> rows = {
      "| step | a number with its unit | 100 us | of the physics; every period is a whole multiple of it |",
      "| name | a text | required | what reports call it, once a scenario |",
      "| slow | a whole number, 1 to 10000 | 1 | so many times slower than the machine |",
      "| type | backlash_axis, ",
      "| video | on or off | off | the frames as a film too |",
  };
  for (const auto& row : rows) EXPECT_THAT(text, HasSubstr(row));
}

TEST(Reference, HasTheKeysThatCamTablesTake) {
  const auto text = text_of(cam_table_page());
  for (const auto& kind : cams::cam_kinds()) {
    for (const auto& key : kind.keys()) {
      SCOPED_TRACE(std::string(kind.name) + " " + key.name);
      EXPECT_THAT(text, HasSubstr("| " + key.name + " | " + key.values + " |"));
      Problems problems;
      kind.read("# " + key.name + ": ?\n", "cam.csv", problems);
      for (const auto& problem : problems) {
        EXPECT_THAT(problem.what, Not(HasSubstr("there is no setting")));
        EXPECT_THAT(problem.what, Not(HasSubstr("unknown key")));
      }
    }
    for (const auto& column : kind.columns()) EXPECT_THAT(text, HasSubstr("| " + column.name + " |"));
  }
}

}  // namespace
}  // namespace drycut::sim::cli
