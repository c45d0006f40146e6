#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "sim/live/protocol.hpp"
#include "sim/live/site.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim::live {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(LiveSite, HasThePageAndItsParts) {
  const Site site;
  EXPECT_THAT(std::string(site.find("/")->bytes), HasSubstr("live.css"));
  EXPECT_STREQ(site.find("/")->type, "text/html; charset=utf-8");
  EXPECT_STREQ(site.find("/live.css")->type, "text/css; charset=utf-8");
  EXPECT_STREQ(site.find("/live.js")->type, "text/javascript; charset=utf-8");
}

TEST(LiveSite, HasEveryPartThatThePageNames) {
  const Site site;
  const std::regex name(R"re((?:src|href|from) ?=? ?"(?:\./)?([a-zA-Z_.]+\.(?:js|css))")re");
  std::vector<std::string> parts{""};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto file = site.find("/" + parts[i]);
    ASSERT_TRUE(file.has_value()) << parts[i];
    const std::string text(file->bytes);
    for (std::sregex_iterator at(text.begin(), text.end(), name), end; at != end; ++at)
      if (std::find(parts.begin(), parts.end(), (*at)[1]) == parts.end()) parts.push_back((*at)[1]);
  }
  EXPECT_THAT(parts, testing::IsSupersetOf(
                         {"live.css", "palette.css", "view.js", "live.js", "live_scope.js", "three.min.js"}));
}

TEST(LiveSite, GivesNothingElse) {
  const Site site;
  for (const auto* path :
       {"", "/report.css", "/drum.stl", "/../Makefile", "/live", "/live.html/", "/line.json", "live.html"})
    EXPECT_FALSE(site.find(path).has_value()) << path;
}

TEST(LiveSite, TakesThreeFromItsFolder) {
  const TestFolder folder;
  folder.file("three.min.js", "var THREE;");
  const Site site(folder.path);
  EXPECT_EQ(site.find("/three.min.js")->bytes, "var THREE;");
  EXPECT_EQ(site.find("/GLTFLoader.js")->bytes, "");  // the page says what is missing
}

News::Samples two_rows() {
  return {std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"a", "b", "c"}),
          {0, millisecond},
          {1, 2, 3, 4, 5, std::nan("")}};
}

TEST(LiveSamples, EveryRowOrTheLatestValue) {
  const auto json = json::parse(samples_json(two_rows(), {{"c", "a", "b"}, 1}))["samples"];
  EXPECT_EQ(json, json::parse(R"({"names": ["c", "a"], "times": [0.0, 0.001], "rows": [3.0, 1.0, null, 4.0],
                                  "watched": {"b": 5.0}})"));
}

TEST(LiveSamples, WatchedAlone) {
  const auto json = json::parse(samples_json(two_rows(), {{"c", "a"}, 2}))["samples"];
  EXPECT_EQ(json, json::parse(R"({"names": [], "times": [], "rows": [], "watched": {"c": null, "a": 4.0}})"));
}

TEST(LiveSamples, NothingWithoutWishOrKnowledge) {
  EXPECT_EQ(samples_json(two_rows(), {}), "");
  EXPECT_EQ(samples_json(two_rows(), {{"d"}, 0}), "");
  EXPECT_EQ(samples_json({}, {{"a"}, 0}), "");
}

TEST(LiveSamples, AreAskedFor) {
  const auto sample_of = [](const char* message) {
    double id = 0;
    Problems problems;
    const auto request = parse_request(message, 1, id, problems);
    EXPECT_TRUE(problems.empty() && request) << message;
    return std::get<Sample>(request.value().what);
  };
  EXPECT_THAT(sample_of(R"({"sample": ["a"], "watch": ["b", "c"]})").names, ElementsAre("a", "b", "c"));
  EXPECT_EQ(sample_of(R"({"sample": ["a"], "watch": ["b", "c"]})").watched, 2U);
  EXPECT_EQ(sample_of(R"({"sample": ["a"]})").watched, 0U);
  EXPECT_EQ(sample_of(R"({"watch": ["a"]})").watched, 1U);
}

TEST(LiveSamples, MayAskForThePrograms) {
  double id = 0;
  Problems problems;
  const auto asked = parse_request(R"({"watch": [], "programs": true})", 1, id, problems);
  ASSERT_TRUE(asked.has_value());
  EXPECT_TRUE(std::get<Sample>(asked->what).programs);
  const auto silent = parse_request(R"({"watch": []})", 1, id, problems);
  ASSERT_TRUE(silent.has_value());
  EXPECT_FALSE(std::get<Sample>(silent->what).programs);
  EXPECT_TRUE(problems.empty());
  EXPECT_FALSE(parse_request(R"({"programs": 1})", 1, id, problems));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].what, "programs is true or false");
}

TEST(LiveProtocol, ProgramsAreTextsWithTheValuesOfEachLine) {
  LineDescription line;
  line.programs.emplace_back("folder/a.mod", "qcl", "x = y\n\nEND\n");
  line.programs[0].add_value(1, "x");
  line.programs[0].add_value(1, "y");
  line.programs[0].add_value(1, "x");
  line.targets.push_back({"panel.push", "", {}, true, true, 0});
  line.targets.push_back({"web.speed", "m/min", devices::ValueRange{0, 1000}, false, {}, 60});
  const auto told = json::parse(description_json(line))["line"];
  EXPECT_EQ(told["programs"], json::parse(R"([{"name": "a.mod", "file": "folder/a.mod", "language": "qcl",
                                               "text": "x = y\n\nEND\n", "values": {"1": ["x", "y"]}}])"));
  EXPECT_EQ(told["targets"][0]["push"], true);
  EXPECT_FALSE(told["targets"][1].contains("push"));
  EXPECT_EQ(told["targets"][1]["used"], 60);
}

TEST(LiveProtocol, PositionsAreToldIfTheyAreWanted) {
  News news;
  EXPECT_FALSE(json::parse(news_json(news))["news"].contains("programs"));
  news.programs = devices::ProgramPositions{{{"a", 0, 3, "waits", {7, 9}}}, {"+- ", ""}};
  EXPECT_EQ(
      json::parse(news_json(news))["news"]["programs"],
      json::parse(R"({"tasks": [{"name": "a", "program": 0, "line": 3, "doing": "waits", "calls": [7, 9]}],
                            "scanned": ["+- ", ""]})"));
}

TEST(LiveSamples, ListsOfNames) {
  for (const auto* message :
       {R"({"sample": "a"})", R"({"watch": [1]})", R"({"sample": ["a"], "watch": {}})"}) {
    double id = 0;
    Problems problems;
    EXPECT_FALSE(parse_request(message, 1, id, problems)) << message;
    EXPECT_EQ(problems.size(), 1U) << message;
  }
}

}  // namespace
}  // namespace drycut::sim::live
