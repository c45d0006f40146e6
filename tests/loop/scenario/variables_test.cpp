// variables: what ${name} becomes, in scenarios and in tables.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "sim/scenario/constant.hpp"
#include "sim/scenario/variables.hpp"
#include "tests/loop/scenario/fake_plants.hpp"

namespace drycut::sim::scenario {
namespace {

using fakes::problems_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Constant, IsComputedWithItsUnits) {
  struct Case {
    const char* text;
    const char* value;
  };
  for (const auto& [text, value] : {
           Case{"800 mm / 2 + 3 mm", "403 mm"},
           Case{"(800 mm) / (0.1 mm)", "8000"},
           Case{"0.8 m + 3 mm", "0.803 m"},
           Case{"(60 m/min) * 2", "120 m/min"},
           Case{"(60 m/min) * (2 s)", "2 m"},
           Case{"0.8 m / 1 mm", "800"},
           Case{"0.1 + 0.2", "0.3"},
           Case{"-(3 mm)", "-3 mm"},
           Case{"max(3 mm, 1 cm)", "10 mm"},
           Case{"sqrt((3 mm)^2 + (4 mm)^2)", "5 mm"},
           Case{"1 / (2 s)", "0.5 s-1"},
           Case{"2 > 1 ? 5 mm : 6 mm", "5 mm"},
           Case{"50 % * (800 mm)", "0.4 m"},
           Case{"90 deg * 2", "180 deg"},
       }) {
    const auto made = read_constant(text);
    EXPECT_EQ(made.kind, Constant::Kind::value) << text;
    EXPECT_THAT(made.faults, IsEmpty()) << text;
    EXPECT_EQ(made.value, value) << text;
  }
}

TEST(Constant, IsToldFromOtherTexts) {
  using Kind = Constant::Kind;
  const std::vector<std::pair<const char*, Kind>> texts = {
      {"abs(length - 800 mm) <= 0.1", Kind::formula},
      {"max(AxisX.follerr) + 3", Kind::formula},
      {"3 mm > 2 mm", Kind::condition},
      {"Rotary knife, 800 mm pieces", Kind::text},
      {"Pieces of (800 mm)", Kind::text},
      {"programs/saw_2m.st", Kind::formula},
      {"800 mm /", Kind::text},
      {"", Kind::text},
  };
  for (const auto& [text, kind] : texts) EXPECT_EQ(read_constant(text).kind, kind) << text;
}

TEST(Constant, RefusesUnitsThatDoNotFit) {
  // A number without unit is none that fits anywhere, unlike in checks.
  for (const auto* text :
       {"800 mm + 3 s", "800 mm + 3", "3 + 800 mm", "min(3, 2 mm)", "1 / 0", "sqrt(0 - 1)"}) {
    const auto made = read_constant(text);
    EXPECT_EQ(made.kind, Constant::Kind::value) << text;
    EXPECT_EQ(made.faults.size(), 1U) << text;
  }
}

const std::string plants =
    "plants:\n  web: {type: web, speed: 60 m/min}\n"
    "  knife: {type: rotary_knife, web: web, circumference: \"${circle} / 2 + 3 mm\"}\n";

TEST(Variables, StandWhereverAValueStands) {
  std::vector<std::string> problems;
  const auto scenario = fakes::read(
      "variables: {circle: 1194 mm, half: \"${circle} / 2\", shown: on, axis: AxisX, stop: -3 mm, n: 2}\n"
      "scene: {title: \"${axis}: ${circle} round, ${n} of them\", duration: \"${n} * 3 s\", seed: "
      "\"${n}\"}\n" +
          plants +
          "controller:\n  qmove: {configuration: \"p/${axis}.cnf\", set: {slLength: \"${circle} / 0.1 "
          "mm\"}}\n"
          "record: {channels: [\"${axis}.posit\"]}\n"
          "checks:\n"
          "  - {name: a, each: cut, expect: \"abs(length - ${circle}) <= ${half} / 100\"}\n"
          "  - {name: b, always: \"${axis}.posit > ${stop}\"}\n"
          "pictures: {frames: {every: 40 ms}, video: \"${shown}\"}\n",
      problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(scenario.scene.title, "AxisX: 1194 mm round, 2 of them");
  EXPECT_EQ(scenario.scene.duration, 6 * second);
  EXPECT_EQ(scenario.scene.seed, 2U);
  EXPECT_NEAR(dynamic_cast<fakes::FakeKnife&>(*scenario.plants[1].definition).circumference, 0.6, 1e-15);
  EXPECT_EQ(scenario.controller->set.at(0).second, 11940);
  EXPECT_EQ(scenario.controller->files().back().text, "p/AxisX.cnf");
  EXPECT_EQ(scenario.record.channels.at(0).text, "AxisX.posit");
  EXPECT_EQ(scenario.checks[0].expression.text, "abs(length - 1194 mm) <= (597 mm) / 100");
  EXPECT_EQ(scenario.checks[1].expression.text, "AxisX.posit > (-3 mm)");
  EXPECT_TRUE(scenario.pictures.video);
  EXPECT_THAT(expand(scenario), HasSubstr("variables:\n  circle: 1194 mm\n  half: 597 mm\n"));
  EXPECT_THAT(expand(scenario), HasSubstr("circumference: 600 mm"));
}

TEST(Variables, WhatIsPrintedReadsBack) {
  std::vector<std::string> problems;
  const auto scenario = fakes::read("variables: {circle: 3 * 200 mm}\n" + plants, problems);
  const auto again = fakes::read(expand(scenario), problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(expand(again), expand(scenario));
}

TEST(Variables, AreOverridden) {
  std::vector<std::string> problems;
  const auto scenario = fakes::read("variables: {base: 400 mm, circle: \"${base} * 2\"}\n" + plants, problems,
                                    {{"variables.base", "1 m"}, {"scene.title", "of ${base}"}});
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_NEAR(dynamic_cast<fakes::FakeKnife&>(*scenario.plants[1].definition).circumference, 1.003, 1e-15);
  EXPECT_EQ(scenario.scene.title, "of 1 m");
  EXPECT_THAT(problems_of("variables: {circle: 400 mm}\n" + plants, {{"variables.circel", "1 m"},
                                                                     {"circle", "1 m"},
                                                                     {"plants.web.speed", "${circle} / 2"},
                                                                     {"extends", "x"}}),
              ElementsAre("--set variables.circel:1:1: there is no 'circel' in variables; did you mean "
                          "circle? [option.set-path]",
                          "--set circle:1:1: there is no 'circle' in the scenario; it is a variable: --set "
                          "variables.circle=1 m [option.set-path]",
                          "--set plants.web.speed:1:1: plants.web.speed is a speed, not a length (mm); for "
                          "example 1 m/min [scenario.wrong-unit]",
                          HasSubstr("--set extends:1:1: what a scenario extends cannot be set")));
}

TEST(Variables, ToldWhereTheyStand) {
  struct Case {
    std::string text;
    std::string told;
  };
  const std::string use = "scene:\n  duration: ";
  for (const auto& [text, told] : {
           Case{"variables: {length: 1 s}\n" + use + "2 * ${lenght}\n",
                "3:17: there is no variable 'lenght'; did you mean length?"},
           Case{use + "${x}\n", "2:13: there is no variable 'x'; add variables: {x: 800 mm}"},
           Case{"variables: {x: 1 s}\n" + use + "${x + 1 s}\n",
                "3:13: 'x + 1 s' is no name of a variable; the name alone stands in ${ }, arithmetic around "
                "it: "
                "${length} / 2"},
           Case{"variables: {x: 1 s}\n" + use + "2 * ${x\n", "3:17: this ${ is not closed; write ${name}"},
           Case{"variables: {a: \"${b} * 2\", b: \"1 s + ${a}\"}\n" + use + "${b}\n",
                "1:38: the variable 'a' needs itself: a -> b -> a; give one of them a value of its own"},
           Case{"variables: {a: \"${a}\"}\n",
                "1:17: the variable 'a' needs itself: a -> a; give one of them a value of its own"},
           Case{"variables: {l: 800 mm}\n" + use + "${l}\n",
                "1:16: variables.l is a length (800 mm); it is used as a time (at 3:13); write 800 ms"},
           Case{"variables: {l: 800 mm, bad: \"${l} + 1 s\"}\n",
                "1:16: variables.l is a length (800 mm); it is used as a time (at 1:37); write 800 ms"},
           Case{"variables: {v: 90 m/s}\nplants: {web: {type: web, speed: \"${v}\"}}\n",
                "1:16: variables.v is 90 m/s, which is out of range (at 2:35); write 90 m/min"},
           Case{"variables: {l: 800 mn}\n", "1:20: variables.l: unknown unit 'mn'"},
           Case{"variables: {2m: 2 m}\n", "1:13: '2m' is no name of a variable"},
           Case{"variables: {l: [1, 2]}\n", "1:16: variables.l must be a single value, not a list"},
           Case{"variables: {l: }\n", "1:13: "},
           Case{"variables: {a: 1 s}\n" + use + "{${a}: 3}\n", ""},
           Case{"variables: {a: x}\nwiring:\n  ${a}: b.c\n", "3:3: a variable cannot stand in a key"},
           Case{"variables: {a: 1}\ncontroller: {qmove: {set: {x: ${a}}}}\n",
                "inside { } and [ ] a value with ${name} stands in quotes"},
       }) {
    const auto problems = problems_of(text);
    ASSERT_FALSE(problems.empty()) << text;
    EXPECT_THAT(problems.front(), HasSubstr(told)) << text;
    if (!told.empty() && told != "inside { } and [ ] a value with ${name} stands in quotes") {
      EXPECT_EQ(problems.size(), 1U) << text;
    }
  }
}

TEST(Variables, DoNotGrowWithoutEnd) {
  std::string doubling = "variables:\n  v0: abcdefghij\n";
  std::string chain = "variables:\n  v0: 1 s\n";
  for (int i = 1; i <= 200; ++i) {
    doubling += fmt::format("  v{0}: ${{v{1}}}${{v{1}}}\n", i, i - 1);
    chain += fmt::format("  w{0}: ${{w{1}}}\n", i, i + 1);
  }
  EXPECT_THAT(problems_of(doubling),
              testing::Contains(HasSubstr("this comes to 10240 characters; at most 10000")));
  EXPECT_THAT(problems_of(chain + "  w201: 1 s\n"),
              testing::Contains(HasSubstr("variables in variables, more than 100 deep")));
  EXPECT_THAT(problems_of("variables: {a: $, b: x}\nscene: {title: \"${a}{b}\"}\n"),
              ElementsAre(HasSubstr("2:17: this comes to a text with ${ in it")));
}

std::vector<VariableEntry> of_length() {
  return {{{"length", {}}, {"800 mm", {}}}, {{"kind", {}}, {"saw", {}}}};
}

TEST(Variables, InATableBecomeNumbersThatKeepTheColumns) {
  Problems problems;
  const auto table = with_variables(
      "# master_modulo: ${length} / 0.0001 mm\n# of ${length} a piece: free\nD100, ${length} / 0.05 mm ,7\n"
      "  Lines = ${length} / 400 mm\n",
      of_length(), "r.csv", problems);
  EXPECT_THAT(problems, IsEmpty());
  EXPECT_EQ(
      table,
      "# master_modulo: 8000000              \n# of ${length} a piece: free\nD100, 16000               ,7\n"
      "  Lines = 2                 \n");
}

TEST(Variables, InATableAreToldAtTheirPlace) {
  Problems problems;
  with_variables("a,b\n1, ${lenght}\n2,${length}\n3,${kind}\n4,${length} + 3 s\n", of_length(), "r.csv",
                 problems);
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_EQ(
      to_string(problems[0]),
      "r.csv:2:4: the scenario has no variable 'lenght'; did you mean length? [scenario.unknown-variable]");
  EXPECT_EQ(to_string(problems[1]),
            "r.csv:3:3: '${length}' is 800 mm, not a plain number; divide by the table's unit: ${length} / "
            "0.1 mm [scenario.variable-value]");
  EXPECT_THAT(to_string(problems[2]), HasSubstr("r.csv:4:3: '${kind}' is saw, not a plain number"));
  EXPECT_THAT(to_string(problems[3]), HasSubstr("r.csv:5:"));
}

}  // namespace
}  // namespace drycut::sim::scenario
