#include "devices/contradictions.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <string>
#include <vector>

#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/qmove_controller.hpp"

// Opposite commands of one sample (issue: an emergency is never lost in silence). The table's order stays.
namespace drycut::devices {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const DeviceType& type_of(std::string_view name) {
  for (const CatalogueEntry& entry : catalogue())
    if (entry.type->name == name) return *entry.type;
  throw std::invalid_argument("no such type");
}

/// The opposites of `command`, in the table's order.
std::vector<std::string> opposites(std::string_view type_name, std::string_view command) {
  const DeviceType& type = type_of(type_name);
  std::vector<std::string> names;
  for (std::uint64_t set =
           contradictions(type).at(static_cast<std::size_t>(find_command(type, command).value()));
       set != 0; set &= set - 1)
    names.emplace_back(type.commands[static_cast<std::size_t>(std::countr_zero(set))].name);
  return names;
}

TEST(Contradictions, FollowFromEffectsAndMovements) {
  EXPECT_THAT(opposites("CAMMING4", "EMRG"), ElementsAre("RESUME"));
  EXPECT_THAT(opposites("CAMMING4", "LOOPON"), ElementsAre("LOOPOFF"));
  EXPECT_THAT(opposites("CAMMING4", "CALOFF"), ElementsAre("CALON"));
  EXPECT_THAT(opposites("CAMMING4", "REGON"), ElementsAre("REGOFF"));
  EXPECT_THAT(opposites("CAMMING4", "CNTLOCKM"), ElementsAre("CNTUNLOCKM"));
  EXPECT_THAT(opposites("CAMMING4", "CNTDIR"), ElementsAre("CNTREV"));
  EXPECT_THAT(opposites("CAMMING4", "INTENBL"), ElementsAre("INTDSBL"));
  EXPECT_THAT(opposites("CAMMING4", "STOPCAM"), ElementsAre("STARTCAM"));
  EXPECT_THAT(opposites("CAMMING4", "STOP"), ElementsAre("START", "PRESET", "MANFW", "MANBW"));
  EXPECT_THAT(opposites("CAMMING4", "START"), ElementsAre("STOP", "PRESET", "MANFW", "MANBW", "STARTCAM"));
  EXPECT_THAT(opposites("CAMMING4", "DELCNT"), IsEmpty());
  EXPECT_THAT(opposites("CAMMING4", "INIT"), IsEmpty());
  EXPECT_THAT(opposites("EPICPOS", "RESUME"), ElementsAre("EMRG"));
  EXPECT_THAT(opposites("EANPOS", "CNTLOCK"), ElementsAre("CNTUNLOCK"));
  EXPECT_THAT(opposites("OOPOS2", "STOP"),
              ElementsAre("START", "PRESET", "MANSFW", "MANSBW", "MANFFW", "MANFBW"));
}

/// A controller with one EPICPOS and tasks that wait for the operator's `gfGo` and then run once.
struct Panel {
  Problems problems;
  std::unique_ptr<qmove::QmoveController> controller;
  std::int64_t now = 0;

  explicit Panel(const std::vector<std::pair<std::string, std::string>>& tasks) {
    const qmove::Configuration configuration = qmove::parse_configuration(
        "GLOBAL\ngfGo F\nBUS\n1 1CPUB 02\n2 1MIXA 00\nINTDEVICE\nAxis EPICPOS 2 2.CNT01 X X.X 2.AN01\nEND\n",
        "panel.cnf", catalogue(), problems);
    std::vector<qmove::QclProgram> programs;
    for (const auto& [name, orders] : tasks)
      programs.push_back(qmove::compile_module(
          "INIT Axis\nWAIT Axis:st_init\nMAIN:\nWAIT gfGo\n" + orders + "WAIT NOT gfGo\nJUMP MAIN\nEND\n",
          name + ".mod", configuration, catalogue(), problems));
    controller = std::make_unique<qmove::QmoveController>(configuration, programs, catalogue(), 2'000'000);
    run(10);
    static_cast<void>(told());
  }
  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i, now += 1'000'000) {
      controller->run_devices(now);
      controller->run_tasks(now);
    }
  }
  void go(double level) {
    controller->find("gfGo")->write(level);
    run(10);
  }
  std::vector<std::string> told() {
    std::vector<std::string> texts;
    for (const ControllerEvent& event : controller->take_events())
      if (event.event == "contradiction") texts.push_back(event.source + ": " + event.text);
    return texts;
  }
};

const std::string lost =
    "Axis: EMRG of guard and RESUME of hmi: both in one sample, EMRG is taken first; st_emrg is 0 after both";

TEST(Contradictions, ALostEmergencyNamesBothTasksWhateverTheirOrder) {
  const std::pair<std::string, std::string> guard{"guard", "EMRG Axis\n"};
  const std::pair<std::string, std::string> hmi{"hmi", "RESUME Axis\n"};
  for (const auto& tasks : {std::vector{guard, hmi}, std::vector{hmi, guard}}) {
    Panel panel(tasks);
    ASSERT_TRUE(panel.problems.empty());
    panel.go(1);
    EXPECT_THAT(panel.told(), ElementsAre(lost));
    EXPECT_EQ(panel.controller->find("Axis.st_emrg")->read(), 0);
  }
}

TEST(Contradictions, AnEmergencyLostAgainIsToldAgain) {
  Panel panel(
      {{"guard", "EMRG Axis\n"}, {"hmi", "RESUME Axis\n"}, {"third", "WAIT 1\nWAIT 1\nWAIT 1\nEMRG Axis\n"}});
  panel.go(1);
  EXPECT_THAT(panel.told(), ElementsAre(lost));
  EXPECT_EQ(panel.controller->find("Axis.st_emrg")->read(), 1);  // the third one's, alone
  panel.go(0);
  panel.go(1);
  EXPECT_THAT(panel.told(), ElementsAre(lost));
}

TEST(Contradictions, RepeatedEachScanItIsToldOnce) {
  Panel panel({{"guard", "AGAIN:\nLOOPON Axis\nWAIT 1\nJUMP AGAIN\n"},
               {"hmi", "AGAIN:\nLOOPOFF Axis\nWAIT 1\nJUMP AGAIN\n"}});
  panel.go(1);
  panel.run(1000);
  EXPECT_THAT(panel.told(),
              ElementsAre("Axis: LOOPON of guard and LOOPOFF of hmi: both in one sample, LOOPON is "
                          "taken first; st_loopon is 0 after both"));
}

TEST(Contradictions, StartAndStopAreTakenInTheManualsOrder) {
  Panel panel({{"saw", "START Axis\n"}, {"guard", "STOP Axis\n"}, {"hmi", "STOP Axis\n"}});
  panel.go(1);
  EXPECT_THAT(
      panel.told(),
      ElementsAre(
          "Axis: START of saw and STOP of guard and of hmi: both in one sample, START is taken first"));
}

TEST(Contradictions, OneAfterTheOtherAreNone) {
  Panel panel(std::vector<std::pair<std::string, std::string>>{
      {"guard", "EMRG Axis\nWAIT Axis:st_emrg\nRESUME Axis\n"}});
  panel.go(1);
  EXPECT_THAT(panel.told(), IsEmpty());
  EXPECT_EQ(panel.controller->find("Axis.st_emrg")->read(), 0);
}

}  // namespace
}  // namespace drycut::devices
