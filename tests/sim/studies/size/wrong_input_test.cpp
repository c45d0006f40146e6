// What drycut size says of wrong input, before anything runs.
#include <functional>

#include "tests/sim/studies/size/size_bench.hpp"

namespace drycut::sim::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST_F(SizeCommand, BadInputIsToldBeforeAnythingRuns) {
  folder.file("two.yaml", "plants:\n  a: {type: linear_axis}\n  b: {type: linear_axis, place: {x: 2 m}}\n");
  folder.file("one.yaml", "plants:\n  a: {type: linear_axis}\n");
  folder.file("web.yaml", "plants:\n  web: {type: web}\n");
  folder.file(
      "own.yaml",
      "plants:\n  web: {type: web}\n  knife:\n    type: rotary_knife\n    servo: {rated_torque: 9 N m}\n");
  folder.file("inverter.yaml", "plants:\n  a: {type: linear_axis, drive: inverter}\ndrives: {cycle: 1 s}\n");
  folder.file("contactors.yaml",
              "plants:\n  a: {type: linear_axis, drive: contactors}\ndrives: {cycle: 1 s}\n");
  folder.file("no.csv", "a,b\n1,2\n");
  folder.file("nowhere.csv", "variables.length [mm],verdict,limit,holds from [mm]\n500,nowhere,x,\n");
  folder.file("torn.csv",
              "variables.length [mm],verdict,limit,holds from [mm]\n500,found,x,1,2\n,found,x,1\n");
  folder.file("unknown.csv", "variables.lengt [mm],verdict,limit,holds from [mm]\n500,found,x,1\n");
  struct Case {
    const char* told;
    std::function<void(SizeOptions&)> change;
  };
  const auto file = [&](const char* name) { return folder / name; };
  const auto shared = shipped("shared_drive.yaml");
  const std::vector<Case> cases = {
      {"--motors:1:1: there is no motor 'HG-SR203' for knife.servo; did you mean HG-SR",
       [](auto& o) { o.motors = "HG-SR203"; }},
      {"--motors:1:10: there is no motor 'Z*' for knife.servo; all, NAME or a pattern",
       [](auto& o) { o.motors = "HG-SR202,Z*"; }},
      {"--motors:1:10: a motor without a name", [](auto& o) { o.motors = "HG-SR202,"; }},
      {"--motors:1:1: there is no motor 'Sg180L-4'", [](auto& o) { o.motors = "Sg180L-4"; }},
      {"--gears:1:1: plants.knife.gear.ratio", [](auto& o) { o.gears = "0..0.001:3"; }},
      {"--gears:1:3: 'abc' is no number as the others are", [](auto& o) { o.gears = "5,abc"; }},
      {"--gears:1:5: 'mm' is no kind of gear", [](auto& o) { o.gears = "5,7 mm"; }},
      {"does not say how many values", [](auto& o) { o.gears = "5..7"; }},
      {"--gears:1:6: 1 values from end to end", [](auto& o) { o.gears = "5..7:1"; }},
      {"--gears:1:1: 1 motors x 20001 gears x 1 brake resistors are 20001 candidates; at most 20000 "
       "[study.out-of-range]",
       [](auto& o) { o.gears = "5..7:20001"; }},
      {"variables.ger: there is no 'ger' in variables", [](auto& o) { o.gears = "variables.ger=5,7"; }},
      {"--gears:1:16: 'planetery' is no kind of gear; did you mean planetary? [study.argument]",
       [](auto& o) { o.gears = "5 planetary, 7 planetery"; }},
      {"plants.knife.gear.efficiency is given: every gear that is tried would keep it",
       [](auto& o) {
         o.gears = "5 planetary";
         o.set = {"plants.knife.gear.efficiency=0.9"};
       }},
      {"--resistors:1:7: 'warm' is no brake resistor", [](auto& o) { o.resistors = "100 W,warm"; }},
      {"--resistors:1:1: '5 ohm' is no brake resistor", [](auto& o) { o.resistors = "5 ohm"; }},
      {"--resistors:1:1: '5 m' is no brake resistor", [](auto& o) { o.resistors = "5 m"; }},
      {"--resistors:1:1: '-5 W' is no brake resistor", [](auto& o) { o.resistors = "-5 W"; }},
      {"--resistors:1:1: '100' is no brake resistor", [](auto& o) { o.resistors = "100"; }},
      {"resistor_power", [](auto& o) { o.resistors = "1e9 W"; }},
      {"--inertia-ratio:1:1: '-5' is no ratio of inertias", [](auto& o) { o.inertia_ratio = "-5"; }},
      {"--inertia-ratio:1:1: '15 mm' is no ratio of inertias", [](auto& o) { o.inertia_ratio = "15 mm"; }},
      {"--inertia-ratio:1:1: 'of' is no ratio of inertias; load over rotor, above 0, such as 15; off: it is "
       "not judged [study.argument]",
       [](auto& o) { o.inertia_ratio = "of"; }},
      {"--at:1:1: 'length' is no PATH=VALUE", [](auto& o) { o.at = {"length"}; }},
      {"--at:1:25: variables.length is given twice",
       [](auto& o) { o.at = {"variables.length=800 mm,variables.length=1 m"}; }},
      {"--at:1:1: lengt=800 mm: there is no 'lengt' in variables",
       [](auto& o) { o.at = {"variables.lengt=800 mm"}; }},
      {"--at:1:1: plants.knife.servo.model is what is sized",
       [](auto& o) { o.at = {"plants.knife.servo.model=HG-SR52"}; }},
      {"--at:1:1: plants.knife.gear.ratio is what is sized",
       [](auto& o) {
         o.gears = "5,7";
         o.at = {"plants.knife.gear.ratio=5"};
       }},
      {"no.csv:1:1: this is no envelope.csv", [&](auto& o) { o.corners = file("no.csv"); }},
      {"nowhere.csv:1:1: at none of its points everything holds",
       [&](auto& o) { o.corners = file("nowhere.csv"); }},
      {"torn.csv:2:1: 5 cells, where the heading has 4", [&](auto& o) { o.corners = file("torn.csv"); }},
      {"torn.csv:3:1: variables.length has no value", [&](auto& o) { o.corners = file("torn.csv"); }},
      {"unknown.csv:1:1: lengt=500 mm: there is no 'lengt'",
       [&](auto& o) { o.corners = file("unknown.csv"); }},
      {"gone.csv", [&](auto& o) { o.corners = file("gone.csv"); }},
      {"--drive:1:1: there is no drive 'knif.servo'; did you mean knife.servo? [study.unknown-name]",
       [](auto& o) { o.drive = "knif.servo"; }},
      {"--drive:1:1: the scenario has 2 drives; name one: a.servo, b.servo [option.missing]",
       [&](auto& o) { o.scenario = file("two.yaml"); }},
      {"--drive:1:1: nothing says what a.servo must bear for ever",
       [&](auto& o) { o.scenario = file("one.yaml"); }},
      {"--drive:1:1: no drive of the scenario has a motor of the catalogue; plants of type",
       [&](auto& o) { o.scenario = file("web.yaml"); }},
      {"own.yaml:5:27: plants.knife.servo.rated_torque is given: every motor that is tried would keep it",
       [&](auto& o) { o.scenario = file("own.yaml"); }},
      {"--drive:1:1: gauge.servo drives the motor of lift by turns", [&](auto& o) { o.scenario = shared; }},
      {"--gears:1:1: the speeds of a.drive are its frequencies",
       [&](auto& o) {
         o.scenario = file("inverter.yaml");
         o.motors = "all";
         o.gears = "5,7";
       }},
      {"--resistors:1:1: a.drive has no DC link",
       [&](auto& o) {
         o.scenario = file("contactors.yaml");
         o.motors = "all";
         o.resistors = "100 W";
       }},
      {"gone.yaml", [&](auto& o) { o.scenario = file("gone.yaml"); }},
      {"--set", [](auto& o) { o.set = {"nonsense"}; }},
  };
  const auto plain = options;
  for (const auto& [told, change] : cases) {
    options = plain;
    change(options);
    EXPECT_EQ(run(), bad_input) << told;
    EXPECT_THAT(err, HasSubstr(told));
    EXPECT_FALSE(std::filesystem::exists(options.out)) << told;
  }
  // All of them at once.
  options = plain;
  options.motors = "HG-SR203";
  options.resistors = "warm";
  options.at = {"length"};
  EXPECT_EQ(run(), bad_input);
  EXPECT_THAT(err, AllOf(HasSubstr("--motors"), HasSubstr("--resistors"), HasSubstr("--at")));
}

}  // namespace
}  // namespace drycut::sim::cli
