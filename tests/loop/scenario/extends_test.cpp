// extends: what a scenario takes from another one.
#include <gmock/gmock.h>

#include "sim/controllers/kinds.hpp"
#include "sim/loop/names.hpp"
#include "sim/loop/simulation.hpp"
#include "sim/scenario/variables.hpp"
#include "tests/findings.hpp"
#include "tests/loop/scenario/folder.hpp"

namespace drycut::sim::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Extends = ScenarioFolder;

const std::string base =
    "variables: {speed: 1 m/s}\n"
    "scene: {title: base, duration: 2 s}\n"
    "plants:\n  axis: {type: ideal_axis, speed_at_10v: \"${speed}\"}\n  other: {type: ideal_axis}\n"
    "record: {channels: [axis.position, axis.speed]}\n"
    "checks:\n"
    "  - {name: slow, always: abs(axis.speed) < 10, from: 1 s}\n"
    "  - {name: still, always: axis.speed == 0}\n"
    "  - {name: there, eventually: axis.position > 5}\n";

std::vector<std::string> names_of(const Scenario& scenario) {
  std::vector<std::string> names;
  for (const auto& check : scenario.checks) names.push_back(check.name.text);
  return names;
}

TEST_F(Extends, MergesMapsAndReplacesTheRest) {
  write("base.yaml", base);
  const auto made = read(
      "extends: base.yaml\nscene: {title: mine}\nplants: {other: ~, third: {type: ideal_axis}}\n"
      "record: {channels: [axis.position]}\nvariables: {speed: 2 m/s}\n");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(made.scene.title, "mine");
  EXPECT_EQ(made.scene.duration, 2 * second);
  ASSERT_EQ(made.plants.size(), 2U);
  EXPECT_EQ(made.plants[0].name.text, "axis");
  EXPECT_EQ(made.plants[1].name.text, "third");
  EXPECT_EQ(made.record.channels.size(), 1U);
  EXPECT_EQ(made.checks.size(), 3U);
  EXPECT_THAT(expand(made), HasSubstr("speed_at_10v: 2000 mm/s"));
  EXPECT_THAT(expand(made), testing::Not(HasSubstr("extends")));
}

TEST_F(Extends, ChangesListsByTheNamesOfTheirEntries) {
  write("base.yaml", base);
  const auto made = read(
      "extends: base.yaml\nchecks:\n  slow: {always: abs(axis.speed) < 5}\n  still: ~\n"
      "  far: {always: axis.position < 9}\n");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(names_of(made), ElementsAre("slow", "there", "far"));
  EXPECT_EQ(made.checks[0].expression.text, "abs(axis.speed) < 5");
  EXPECT_EQ(made.checks[0].from, 1 * second);
  const auto replaced = read("extends: base.yaml\nchecks: [{name: one, always: axis.position < 9}]\n");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(names_of(replaced), ElementsAre("one"));
}

TEST_F(Extends, TakesDottedNamesAndNestedMapsForTheSame) {
  write("dotted.yaml", "plants: {axis: {type: ideal_axis, switch1.width: 5 mm, switch1.delay: 2 ms}}\n");
  write("nested.yaml", "plants: {axis: {type: ideal_axis, switch1: {width: 5 mm}}}\n");
  for (const auto* text : {"extends: dotted.yaml\nplants: {axis: {switch1: {width: 7 mm}}}\n",
                           "extends: nested.yaml\nplants: {axis: {switch1.width: 7 mm}}\n"}) {
    const auto made = read(text);
    EXPECT_THAT(told(), IsEmpty()) << text;
    EXPECT_THAT(expand(made), HasSubstr("  width: 7 mm")) << text;
  }
}

TEST_F(Extends, GoesOverSeveralFilesWhoseFileNamesStayTheirs) {
  std::filesystem::create_directories(folder / "common/line");
  write("common/line/base.yaml", base + "controller: {plcopen: {program: p.st, tables: [{file: t.csv}]}}\n");
  write("common/middle.yaml",
        "extends: line/base.yaml\nscene: {title: middle}\n"
        "pictures: {meshes: {axis.x: {file: m.stl}}}\n");
  const auto made = read("extends: common/middle.yaml\nscene: {duration: 3 s}\n");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_EQ(made.scene.title, "middle");
  ASSERT_TRUE(made.controller);
  const auto files = made.controller->files();
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].text, "common/line/p.st");
  EXPECT_EQ(files[1].text, "common/line/t.csv");
  EXPECT_EQ(made.pictures.meshes.at(0).file.text, "common/m.stl");
  // And back: what is printed stands in the scenario's folder.
  Problems none;
  const auto again = read_scenario_text(expand(made), folder / "line.yaml", {}, none);
  EXPECT_THAT(none, IsEmpty());
  EXPECT_EQ(again.controller->files()[0].text, "common/line/p.st");
}

TEST_F(Extends, ProblemsStandInTheFileThatHasThem) {
  write("base.yaml", base);
  read("extends: base.yaml\nvariables: {speed: 3 s}\nplants: {axis: {speed_at_10w: 1 m/s}}\n");
  ASSERT_EQ(told().size(), 2U);
  EXPECT_THAT(told()[0], testing::AllOf(HasSubstr("line.yaml:2:20: variables.speed is a speed (1 m/s, "),
                                        HasSubstr("base.yaml:1:20), not a time; for example 1 m/s")));
  EXPECT_THAT(told()[1], HasSubstr("line.yaml:3:17: unknown key 'speed_at_10w' in plants.axis; did you"));
}

// What was meant for something of the base and does not hit it, each alone and all at once.
TEST_F(Extends, SlipsAreTold) {
  struct Case {
    std::string section;
    std::string line;
    std::string told;  ///< behind the line's number
  };
  const std::vector<Case> cases = {
      {"variables", "spede: 2 m/s",
       "3: the variable 'spede' is not used, and what is extended has none of this name; did you mean speed? "
       "[scenario.unknown-variable]"},
      {"plants", "axs: {speed_at_10v: 2 m/s}",
       "3: plants.axs.type is missing; did you mean axis? [scenario.missing-key]"},
      {"checks", "slwo: {from: 0.2 s}",
       "9: checks.slwo does not say what it checks; did you mean slow? [scenario.missing-key]"},
      {"scene", "tilte: x", "3: unknown key 'tilte' in scene; did you mean title? [scenario.unknown-key]"},
      {"record", "chanels: []",
       "3: unknown key 'chanels' in record; did you mean channels? [scenario.unknown-key]"},
  };
  write("base.yaml", base);
  std::string all = "extends: base.yaml\n";
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [section, line, what] = cases[i];
    problems.clear();
    read("extends: base.yaml\n" + section + ":\n  " + line + "\n");
    EXPECT_THAT(told(), ElementsAre("line.yaml:3:" + what));
    all += section + ":\n  " + line + "\n";
  }
  problems.clear();
  read(all);
  ASSERT_EQ(told().size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i)
    EXPECT_EQ(told()[i], "line.yaml:" + std::to_string(3 + 2 * i) + ":" + cases[i].told);
}

TEST_F(Extends, AnAxisWithoutWiresIsASlip) {
  write("base.yaml",
        "plants: {axis: {type: ideal_axis}}\n"
        "controller: {plcopen: {program: p.st, axes: {Knife: {path: [1 mm, 100]}, Web: {kind: virtual}}}}\n"
        "wiring: {Knife.encoder: axis.encoder}\n");
  const std::string mine = "extends: base.yaml\ncontroller: {plcopen: {axes: ";
  read(mine + "{Knive: {kv: 30 1/s}}}}\n");
  EXPECT_THAT(told(),
              ElementsAre("line.yaml:2:31: the axis 'Knive' has no wire, and what is extended has none of "
                          "this name; did you mean Knife? [scenario.unknown-name]"));
  for (const auto* axes :
       {"{Knife: {kv: 30 1/s}}}}\n", "{Web2: {kind: virtual}}}}\n", "{Other: {kv: 30 1/s}}}}\n",
        "{Knife2: {kv: 30 1/s}}}}\nwiring: {Knife2.encoder: axis.encoder}\n"}) {
    problems.clear();
    read(mine + axes);
    EXPECT_THAT(told(), IsEmpty()) << axes;
  }
}

TEST_F(Extends, AFileThatIsNotThereIsToldWithTheNearest) {
  write("base.yaml", base);
  read("extends: bsae.yaml\n");
  EXPECT_THAT(told(), ElementsAre(testing::EndsWith("; did you mean base.yaml? [file.missing]")));
}

// A new variable that is used, or is like none of the base's, is none; neither is a new plant or check.
TEST_F(Extends, WhatIsNewAndWholeIsNoSlip) {
  write("base.yaml", base);
  write("middle.yaml", "extends: base.yaml\nvariables: {speeds: 3 m/s}\n");
  for (const auto* text :
       {"extends: base.yaml\nvariables: {speed2: 3 m/s}\nplants: {axis: {speed_at_10v: \"${speed2}\"}}\n",
        "extends: base.yaml\nplants: {axis2: {type: ideal_axis}}\n",
        "extends: base.yaml\nchecks: {slow2: {never: x}}\n",
        "extends: middle.yaml\nvariables: {speeds: 4 m/s}\nplants: {axis: {speed_at_10v: "
        "\"${speeds}\"}}\n"}) {
    problems.clear();
    read(text);
    EXPECT_THAT(told(), IsEmpty()) << text;
  }
  read("extends: middle.yaml\nvariables: {speeds: 4 m/s}\n");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("line.yaml:2:13: the variable 'speeds' is not used")));
  problems.clear();
  const auto made = read("extends: base.yaml\nvariables: {other: 3 m/s}\n");
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(sentences(unused_variables(made)),
              ElementsAre("the variable 'other' is not used, and what is extended has none of this name: it "
                          "has speed"));
}

// What a variable measures is said by its first value; another one is told where it is given, not where it is
// used.
TEST_F(Extends, AnOverrideOfAnotherDimensionIsToldWhereItIsGiven) {
  struct Case {
    std::string value;
    std::string is;  ///< "" = it fits
  };
  write("base.yaml",
        "variables: {gap: 3 mm, way: \"${gap} * 2\", n: 2, name: saw}\nscene: {title: \"${way}, ${n}\"}\n");
  const auto refused = [](const std::string& name, const std::string& was, const std::string& is) {
    return "variables." + name + " is " + was + ", not " + is;
  };
  for (const auto& [name, was, cases] :
       {std::tuple{
            std::string("gap"), std::string("a length (3 mm, base.yaml:1:18)"),
            std::vector<Case>{{"4 cm", ""},
                              {"\"${n} * 1 mm\"", ""},
                              {"3 s", "a time; for example 3 mm [scenario.variable-value]"},
                              {"\"${n} * 1 s\"", "a time; for example 3 mm [scenario.variable-value]"},
                              {"4", "a number without unit; for example 3 mm [scenario.variable-value]"},
                              {"wide", "a text; for example 3 mm [scenario.variable-value]"}}},
        {"way",
         "a length (6 mm, base.yaml:1:30)",
         {{"1 in", ""}, {"1 kg", "a mass; for example 6 mm [scenario.variable-value]"}}},
        {"n",
         "a number without unit (2, base.yaml:1:46)",
         {{"3", ""}, {"3 mm", "a length; for example 2 [scenario.variable-value]"}}},
        {"name", "", {{"3 mm", ""}, {"knife", ""}}}})
    for (const auto& [value, is] : cases) {
      SCOPED_TRACE(name + ": " + value);
      std::string unquoted = value;
      std::erase(unquoted, '"');
      for (const bool set : {false, true}) {
        problems.clear();
        if (set)
          read("extends: base.yaml\n", {{"variables." + name, unquoted}});
        else
          read("extends: base.yaml\nvariables:\n  " + name + ": " + value + "\n");
        if (is.empty()) {
          EXPECT_THAT(told(), IsEmpty());
          continue;
        }
        ASSERT_EQ(told().size(), 1U) << told().back();
        auto text = told()[0];
        const auto path = folder.path.string() + "/";
        if (text.find(path) != std::string::npos) text.erase(text.find(path), path.size());
        const auto place =
            set ? "--set variables." + name + ":1:1: "
                : "line.yaml:3:" + std::to_string(name.size() + (value[0] == '"' ? 6 : 5)) + ": ";
        EXPECT_EQ(text, place + refused(name, was, is));
      }
    }
}

// The first value counts, whatever was given between.
TEST_F(Extends, AnOverrideIsHeldAgainstTheFirstValue) {
  write("base.yaml", "variables: {gap: 3 mm}\nscene: {title: \"${gap}\"}\n");
  write("middle.yaml", "extends: base.yaml\nvariables: {gap: 3 s}\n");
  read("extends: middle.yaml\nvariables: {gap: 4 s}\n");
  EXPECT_THAT(told(), ElementsAre(HasSubstr("line.yaml:2:18: variables.gap is a length (3 mm, ")));
  problems.clear();
  read("extends: middle.yaml\nvariables: {gap: 4 mm}\n");
  EXPECT_THAT(told(), IsEmpty());
}

// Cycles, unknown names and a base with problems of its own, all in one run in the order of the files.
TEST_F(Extends, AllProblemsOfBothFilesAtOnce) {
  write("base.yaml", "variables: {a: \"${b}\", b: 1 s}\nscene: {tilte: x, duration: \"${d}\"}\n");
  read("extends: base.yaml\nvariables: {b: \"${a}\", c: \"${c}\"}\nscene: {seed: \"${bb}\"}\nplants: 3\n");
  EXPECT_THAT(told(),
              testing::UnorderedElementsAre(
                  HasSubstr("line.yaml:2:17: the variable 'a' needs itself: a -> b -> a; give one of them"),
                  HasSubstr("line.yaml:2:28: the variable 'c' needs itself: c -> c; give one of them"),
                  HasSubstr("line.yaml:3:16: there is no variable 'bb'; did you mean b?"),
                  HasSubstr("line.yaml:4:9: plants must be a map, not a single value"),
                  HasSubstr("base.yaml:2:9: unknown key 'tilte' in scene; did you mean title?"),
                  HasSubstr("base.yaml:2:30: there is no variable 'd'; add variables: {d: 800 mm}")));
}

TEST_F(Extends, PlacesOfTheRunToo) {
  write("base.yaml", base);
  const auto made = read("extends: base.yaml\nplants: {axis: ~}\n");
  ASSERT_THAT(told(), IsEmpty());
  const loop::Simulation simulation(made, problems);
  ASSERT_FALSE(told().empty());
  for (const auto& problem : told()) EXPECT_THAT(problem, HasSubstr("base.yaml:"));
}

TEST_F(Extends, ToldWhereItIsNamed) {
  struct Case {
    std::string text;
    std::string told;
  };
  write("base.yaml", base);
  write("a.yaml", "extends: b.yaml\n");
  write("b.yaml", "scene: {}\nextends: a.yaml\n");
  write("self.yaml", "extends: ./self.yaml\n");
  write("empty.yaml", "");
  write("broken.yaml", "scene: {title: [\n");
  write("list.yaml", "[1, 2]\n");
  for (const auto& [text, what] : {
           Case{"scene: {}\nextends: none.yaml\n", "line.yaml:2:10: "},
           Case{"extends: a.yaml\n", "b.yaml:2:10: a.yaml extends itself: a.yaml -> b.yaml -> a.yaml"},
           Case{"extends: self.yaml\n", "self.yaml:1:10: self.yaml extends itself: self.yaml -> self.yaml"},
           Case{"extends: line.yaml\n", ""},
           Case{"extends: empty.yaml\n", "line.yaml:1:10: empty.yaml is empty"},
           Case{"extends: broken.yaml\n", "broken.yaml:"},
           Case{"extends: list.yaml\n", "line.yaml:1:10: list.yaml is no scenario"},
           Case{"extends: [base.yaml]\n", "line.yaml:1:10: extends must be a single value, not a list"},
           Case{"extends:\n", "line.yaml:1:1: extends must be a single value, not nothing"},
           Case{"extends: base.yaml\nplants: {axs: ~}\n",
                "line.yaml:2:10: there is no 'axs' to leave out; did you mean axis? [scenario.unknown-name]"},
           Case{
               "extends: base.yaml\nchecks: {slwo: ~}\n",
               "line.yaml:2:10: there is no 'slwo' to leave out; did you mean slow? [scenario.unknown-name]"},
           Case{"extends: base.yaml\nchecks: {slow: 3}\n",
                "line.yaml:2:16: checks.slow must be a map, not a single value"},
           Case{"extends: base.yaml\nchecks: {slow: {from: 0.2 s}, slow: {from: 0.3 s}}\n",
                "line.yaml:2:31: 'slow' is given twice in checks; keep one; the first is at line 2 "
                "[scenario.twice]"},
           Case{"extends: base.yaml\nscene: {title: a, title: b}\n",
                "line.yaml:2:19: 'title' is given twice in scene"},
           Case{"extends: base.yaml\nscene: {title: }\n", "line.yaml:2:9: scene.title has no value"},
           Case{"extends: base.yaml\ntimeline: {at: {}}\n",
                "line.yaml:2:11: timeline must be a list, not a map"},
       }) {
    problems.clear();
    read(text);
    ASSERT_FALSE(told().empty()) << text;
    EXPECT_THAT(told().front(), HasSubstr(what)) << text;
    if (!what.empty() && what != "line.yaml:2:10: ") {
      EXPECT_EQ(told().size(), 1U) << text;
    }
  }
}

TEST_F(Extends, UnusedVariablesAreNoted) {
  write("regs.csv", "register,value\nD100,${used_there}\n");
  write("p.il", "LD M8000\nMOV K1 D0\nEND\n");
  const auto made = read(
      "variables: {used: 1 s, used_there: 5, idle: 3 mm}\nscene: {duration: \"${used}\"}\n"
      "controller: {lx3vp: {program: p.il, registers: regs.csv}}\n");
  ASSERT_THAT(told(), IsEmpty());
  loop::Simulation simulation(made, problems);
  EXPECT_THAT(told(), IsEmpty());
  EXPECT_THAT(codes(simulation.notes_of_setup()), ElementsAre("scenario.unused-variable"));
  for (const auto& value : simulation.controller_values()) {
    if (value.name != "D100") continue;
    EXPECT_EQ(value.read(), 5);
  }
}

}  // namespace
}  // namespace drycut::sim::scenario
