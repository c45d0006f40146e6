// `drycut devices` and `drycut plants`: how a page is chosen, and how it is shown.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/sheet.hpp"
#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

struct Pages : CommandTest {};

TEST_F(Pages, AreChosenByNameInAnyCase) {
  EXPECT_EQ(captured([] { return list_plants("Rotary_Knife", false); }), all_passed);
  EXPECT_THAT(out, testing::StartsWith("rotary_knife: a servo-driven drum"));
  EXPECT_EQ(captured([] { return list_plants("", false); }), all_passed);
  EXPECT_THAT(out, HasSubstr("\nrotary_knife   a servo-driven drum"));
  EXPECT_EQ(captured([] { return list_plants("", true); }), all_passed);
  EXPECT_EQ(json::parse(out).at(0).at("name"), "backlash_axis");
}

TEST_F(Pages, ThatAreNotThereAreToldWithThoseThatAre) {
  EXPECT_EQ(captured([] { return list_plants("rotary_knive", false); }), bad_input);
  EXPECT_EQ(err,
            "drycut plants: there is no plant type 'rotary_knive'; did you mean rotary_knife? "
            "[option.unknown-choice]\n");
  EXPECT_EQ(captured([] { return list_devices("lathe", true); }), bad_input);
  EXPECT_THAT(err, AllOf(testing::StartsWith("drycut devices: there is no device type 'lathe'; there are: "),
                         HasSubstr("CAMMING4, EANPOS, "), HasSubstr(", MC_CamIn, ")));
  EXPECT_EQ(out, "");
}

TEST_F(Pages, OfMotorsSayWhereEachValueIsFrom) {
  EXPECT_EQ(captured([] { return list_motors("", false); }), all_passed);
  EXPECT_THAT(out, AllOf(HasSubstr("\nServo motors, for servo: {model: ...}\n"),
                         ContainsRegex("\n  HG-SR202 +2 +9.5 .* unchecked +Mitsubishi Electric +HG-SR"),
                         ContainsRegex("\n  HC103R +1 .* checked +Mitsubishi Electric +MELDAS"),
                         HasSubstr("\nInduction motors, for induction_motor: {model: ...}\n")));
  EXPECT_EQ(captured([] { return list_motors("hg-sr202", false); }), all_passed);
  EXPECT_THAT(out, AllOf(testing::StartsWith("HG-SR202: servo, Mitsubishi Electric HG-SR"),
                         ContainsRegex("\n  rated_torque +9.5 N m +unchecked: Mitsubishi SH"),
                         ContainsRegex("\n  torque_at_max_speed +19 N m +estimate: ")));
  EXPECT_EQ(captured([] { return list_motors("", true); }), all_passed);
  const auto motors = json::parse(out);
  const auto same = std::find_if(motors.begin(), motors.end(),
                                 [](const auto& motor) { return motor.at("name") == "HG-SR202"; });
  ASSERT_NE(same, motors.end());
  EXPECT_EQ(same->at("values").at(0).at("name"), "rotor_inertia");
  EXPECT_EQ(captured([] { return list_motors("HG-SR203", false); }), bad_input);
  EXPECT_EQ(err,
            "drycut plants --motors: there is no motor 'HG-SR203'; did you mean HG-SR202? "
            "[option.unknown-choice]\n");
}

TEST_F(Pages, OfUnitsSayWhatOneIsInSi) {
  EXPECT_EQ(captured([] { return list_units("torque", false); }), all_passed);
  EXPECT_THAT(out,
              AllOf(ContainsRegex("\n  lb in +0.112984829\n"), ContainsRegex("\n  oz-in +0.00706155181\n")));
  EXPECT_EQ(captured([] { return list_units("torqe", false); }), bad_input);
  EXPECT_THAT(err, HasSubstr("did you mean torque?"));
  EXPECT_EQ(captured([] { return list_units("", true); }), all_passed);
  EXPECT_GT(json::parse(out).size(), 20U);
}

TEST_F(Pages, OfferATemplateForAMotor) {
  EXPECT_EQ(captured([] { return print_motor_template(""); }), all_passed);
  EXPECT_THAT(out, AllOf(HasSubstr("\nkind: servo\n"),
                         HasSubstr("\n    rated_torque: {value: ___ N m, from: sheet}\n")));
  EXPECT_EQ(captured([] { return print_motor_template("induction_motor"); }), all_passed);
  EXPECT_THAT(out, HasSubstr("\nkind: induction_motor\n"));
  EXPECT_EQ(captured([] { return print_motor_template("stepper"); }), bad_input);
}

TEST_F(Pages, OfPlantsTellWhichDriveBringsWhat) {
  captured([] { return list_plants("vertical_press", false); });
  EXPECT_THAT(out, ContainsRegex("\n  drive.slow .*slow speed.* \\(drive: inverter, contactors\\)\n"));
  captured([] { return list_plants("vertical_press", true); });
  const auto press = json::parse(out);
  const auto told = [&](const char* table) {
    std::size_t count = 0;
    for (const auto& row : press.at(table)) count += row.contains("drives") ? 1 : 0;
    return count;
  };
  EXPECT_GT(told("ports"), 0u);
  EXPECT_LT(told("ports"), press.at("ports").size());
}

TEST_F(Pages, OfPlantsCountPartsThatDifferInTheirNumber) {
  captured([] { return list_plants("web", false); });
  EXPECT_THAT(out, AllOf(HasSubstr("\n  piece 1..12 "), Not(HasSubstr("piece 2 "))));
  captured([] { return list_plants("web", true); });
  const auto web = json::parse(out);
  std::size_t pieces = 0;
  for (const auto& part : web.at("parts"))
    pieces += part.at("name").get<std::string>().starts_with("piece ") ? 1 : 0;
  EXPECT_EQ(pieces, 12u);
}

// In a pipe a row is a line; COLUMNS wraps it, and no word is lost.
TEST_F(Pages, FitTheirWidth) {
  const auto widest = [&] {
    std::size_t most = 0;
    for (const auto line : split_lines(out)) most = std::max(most, characters(line));
    return most;
  };
  captured([] { return list_plants("rotary_knife", false); });
  EXPECT_GT(widest(), 200u);
  const auto lines = split_lines(out).size();
  setenv("COLUMNS", "120", 1);
  captured([] { return list_plants("rotary_knife", false); });
  unsetenv("COLUMNS");
  EXPECT_LE(widest(), 120u);
  EXPECT_GT(split_lines(out).size(), lines);
  EXPECT_THAT(out, ContainsRegex("\n  mismatch_limit .* mm/s  +speed mismatch .*\n"));
}

}  // namespace
}  // namespace drycut::sim::cli
