// The verdict on drives, against numbers taken step by step from the machine itself.
#include "sim/loop/drive_judge.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"

namespace drycut::sim::loop {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const auto scenes = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes";

/// A shipped line, run with some values of its own.
struct Line {
  Problems problems;
  scenario::Scenario scenario;
  std::unique_ptr<Simulation> simulation;
  explicit Line(const std::string& scene, const std::map<std::string, std::string>& set,
                bool keeps_events = false) {
    std::vector<scenario::Override> overrides;
    overrides.reserve(set.size());
    for (const auto& [path, value] : set) overrides.push_back({path, value});
    scenario = scenario::read_scenario(scenes / scene, overrides, problems);
    simulation = std::make_unique<Simulation>(scenario, problems);
    if (!problems.empty()) throw std::runtime_error(to_string(problems.front()));
    if (!keeps_events) simulation->keep_nothing();
  }
  [[nodiscard]] std::vector<record::CheckResult> ratings() const {
    std::vector<record::CheckResult> found;
    for (auto& check : simulation->outcome().checks)
      if (check.name == "drive within its ratings") found.push_back(check);
    return found;
  }
};

const record::DriveFigure& figure(const record::DriveVerdict& verdict, const std::string& name) {
  for (const auto& one : verdict.figures)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

TEST(DriveJudge, RmsOfTheWorstTenCyclesIsThatOfItsSteps) {
  Line line("rotary_knife.yaml", {{"scene.duration", "13 s"}});
  auto& simulation = *line.simulation;
  const auto torque = simulation.names().reading("knife.motor.torque").value();
  const auto cuts = simulation.names().reading("knife.cut.number").value();
  std::vector<double> squares;     // of each cycle
  std::vector<std::size_t> steps;  // in it
  double last = 0;
  while (simulation.time() < line.scenario.scene.duration) {
    ASSERT_TRUE(simulation.advance());
    if (cuts.read() != last) {
      last = cuts.read();
      squares.push_back(0);
      steps.push_back(0);
    }
    if (squares.empty()) continue;
    squares.back() += torque.read() * torque.read();
    ++steps.back();
  }
  double worst = 0;
  for (std::size_t i = 1; i + 11 <= squares.size(); ++i) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = i; k < i + 10; ++k) {
      sum += squares[k];
      count += steps[k];
    }
    worst = std::max(worst, std::sqrt(sum / static_cast<double>(count)));
  }
  const auto verdicts = simulation.outcome().drives;
  ASSERT_EQ(verdicts.size(), 1U);
  const auto& verdict = verdicts[0];
  EXPECT_EQ(verdict.drive, "knife.servo");
  EXPECT_EQ(verdict.cycles, std::to_string(squares.size() - 2) + " cycles from cut to cut");
  // The stage sums up five steps at a time: a cycle may begin four steps late.
  EXPECT_NEAR(figure(verdict, "rms torque").value, worst, 2e-3 * worst);
  EXPECT_NEAR(verdict.inertia_ratio, 0.41 / 25 / 46.8e-4, 1e-9);
  EXPECT_TRUE(verdict.holds());
  ASSERT_EQ(line.ratings().size(), 1U);
  EXPECT_TRUE(line.ratings()[0].passed);
}

// The counts of the wheel alone cost 1.6 N m at any speed that is not round: a motor smaller than that finds
// none.
TEST(DriveJudge, AMotorTooSmallFailsAndPassesAtTheSpeedItAdvises) {
  for (const char* scene : {"rotary_knife_short.yaml", "rotary_knife.yaml", "rotary_knife_long.yaml"})
    for (const char* rated : {"1.8 N m", "2 N m"}) {
      SCOPED_TRACE(std::string(scene) + " " + rated);
      std::map<std::string, std::string> small = {{"plants.knife.servo.rated_torque", rated}};
      Line line(scene, small);
      line.simulation->run();
      const auto verdict = line.simulation->outcome().drives.at(0);
      ASSERT_FALSE(verdict.holds()) << text_of(verdict);
      EXPECT_GT(figure(verdict, "rms torque").share, 1);
      const auto check = line.ratings().at(0);
      EXPECT_FALSE(check.passed);
      EXPECT_LT(*check.margin, 0);
      EXPECT_THAT(check.detail, HasSubstr("rms torque"));

      // The advice is an estimate from one run: following it leads there, in at most three.
      double speed = 60.4;
      auto now = verdict;
      for (int run = 0; run < 3 && !now.holds(); ++run) {
        ASSERT_LT(now.advised, 1);
        ASSERT_GT(now.advised, 0.1);
        speed *= now.advised;
        small["plants.web.speed"] = std::to_string(speed) + " m/min";
        small["scene.duration"] = "20 s";
        Line slower(scene, small);
        slower.simulation->run();
        now = slower.simulation->outcome().drives.at(0);
      }
      EXPECT_TRUE(now.holds()) << speed << " m/min: " << text_of(now);
      EXPECT_GT(speed, 15);
      EXPECT_THAT(now.cycles, HasSubstr("from cut to cut"));
    }
}

TEST(DriveJudge, AScenarioNamesItsCycleOrSwitchesTheCheckOff) {
  Line line("rotary_knife.yaml", {{"scene.duration", "4 s"}, {"drives.cycle", "800 ms"}});
  line.simulation->run();
  EXPECT_EQ(line.simulation->outcome().drives.at(0).cycles, "5 cycles of 0.8 s");
  EXPECT_EQ(line.ratings().size(), 1U);
  Line silent("rotary_knife.yaml", {{"scene.duration", "1 s"}, {"drives.judge", "false"}});
  silent.simulation->run();
  EXPECT_TRUE(silent.ratings().empty());
  EXPECT_THAT(silent.simulation->outcome().drives.at(0).cycles, testing::StartsWith("the whole run"));
}

/// Each saturation's share of the cycle, from the events alone.
void expect_shares(const Line& line, double named) {
  double cut = 0;
  double cycle = 0;
  int with_cycle = 0;
  int without = 0;
  for (const auto& event : line.simulation->recording().events()) {
    const double now = event.at_seconds();
    if (event.event == "cut") {
      if (cut > 0) cycle = now - cut;
      cut = now;
    }
    if (event.event != "saturated") continue;
    ASSERT_EQ(event.values.size(), 4U);
    EXPECT_EQ(event.values[3].name, "share");
    EXPECT_EQ(event.values[3].unit, "%");
    const double of = named > 0 ? named : cycle > 0 ? cycle : now;
    ++(named > 0 || cycle > 0 ? with_cycle : without);
    const double time = event.find("end")->number - event.find("begin")->number;
    EXPECT_NEAR(event.values[3].number, std::min(100.0, 100 * time / of), 0.1) << now;
  }
  EXPECT_GT(with_cycle, 3);
  EXPECT_EQ(without > 0, named == 0);
}

TEST(DriveJudge, ASaturationIsToldAsAShareOfTheCycle) {
  // The smaller motor is at its limit when it stops after the search of home, too: that is in no cycle.
  const std::map<std::string, std::string> changes = {{"scene.duration", "8 s"},
                                                      {"plants.knife.servo.peak_torque", "22 N m"}};
  Line cuts("rotary_knife_overload.yaml", changes, true);
  cuts.simulation->run();
  expect_shares(cuts, 0);
  const auto of_cuts =
      figure(cuts.simulation->outcome().drives.at(0), "time at the torque limit, worst cycle");
  EXPECT_FALSE(of_cuts.judged);
  EXPECT_GE(of_cuts.value, figure(cuts.simulation->outcome().drives.at(0), "time at the torque limit").value);
  // A cycle shorter than the saturations: all of it.
  for (const double cycle : {0.5, 0.01}) {
    auto cycled = changes;
    cycled["drives.cycle"] = cycle < 0.1 ? "10 ms" : "500 ms";
    Line named("rotary_knife_overload.yaml", cycled, true);
    named.simulation->run();
    expect_shares(named, cycle);
    if (cycle > 0.1) continue;
    EXPECT_NEAR(
        figure(named.simulation->outcome().drives.at(0), "time at the torque limit, worst cycle").value, 100,
        1e-6);
  }
}

TEST(DriveJudge, ATripFailsWhateverTheMeansAre) {
  Line line("rotary_knife.yaml", {{"scene.duration", "6 s"},
                                  {"plants.knife.servo.overload_time", "20 ms"},
                                  {"plants.knife.servo.amplifier_current", "1 A"}});
  line.simulation->run();
  const auto verdict = line.simulation->outcome().drives.at(0);
  ASSERT_FALSE(verdict.trips.empty());
  EXPECT_THAT(verdict.trips[0], HasSubstr("overload at "));
  EXPECT_FALSE(verdict.holds());
  EXPECT_THAT(line.ratings().at(0).detail, HasSubstr("overload at "));
}

// Sheets of 500 mm are shorter than the drums' circumference: between two cuts these run up and down again.
TEST(DriveJudge, TheCorrugatedLineFailsAt200WithItsReasonsAndPassesAtTheSpeedItAdvises) {
  const char* scene = "rotary_knife_corrugated_500.yaml";
  double speed = 200;
  Line line(scene, {{"plants.board.speed", "200 m/min"}});
  line.simulation->run();
  auto now = line.simulation->outcome().drives.at(0);
  ASSERT_FALSE(now.holds());
  const auto check = line.ratings().at(0);
  EXPECT_FALSE(check.passed);
  EXPECT_THAT(check.detail, testing::StartsWith("knife.servo, each of 2: tripped by overload at "));
  EXPECT_THAT(now.cycles, testing::EndsWith(" cycles from cut to cut, each of 2 drives"));
  EXPECT_THAT(check.detail, HasSubstr("rms torque"));
  EXPECT_THAT(check.detail, HasSubstr("brake resistor"));
  const auto& rms = figure(now, "rms torque");
  EXPECT_GT(rms.share, 1.3);
  EXPECT_GT(figure(now, "brake resistor").share, 1);
  ASSERT_EQ(now.trips.size(), 1U);
  // The amplifier's I2t warms by its time constant towards the square of its load, from the first cut on.
  const double load = figure(now, "rms current, for the amplifier").share;
  const double time_constant = -3 / std::log1p(-37.0 * 37 / (83 * 83));
  double tripped = 0;
  ASSERT_EQ(std::sscanf(now.trips[0].c_str(), "tripped by overload at %lf s", &tripped), 1) << now.trips[0];
  EXPECT_NEAR(tripped - 2.2, -time_constant * std::log1p(-1 / (load * load)), 0.7);
  // Two motors on two drums, one body on the shaft: half of them behind the gear is each motor's load.
  EXPECT_NEAR(now.inertia_ratio, (0.4 + 0.4) / 2 / 25 / 0.0151, 1e-9);

  for (int run = 0; run < 3 && !now.holds(); ++run) {
    ASSERT_LT(now.advised, 1);
    ASSERT_GT(now.advised, 0.3);
    speed *= now.advised;
    Line slower(scene, {{"plants.board.speed", std::to_string(speed) + " m/min"}});
    slower.simulation->run();
    now = slower.simulation->outcome().drives.at(0);
    if (!now.holds()) continue;
    for (const auto& other : slower.simulation->outcome().checks)
      EXPECT_TRUE(other.passed) << other.name << ": " << other.detail;
  }
  EXPECT_TRUE(now.holds()) << speed << " m/min: " << text_of(now);
  EXPECT_GT(speed, 90);
}

/// A motor that is turned by hand, a servo's or one on the mains.
class TurnedByHand : public plants::Plant {
 public:
  explicit TurnedByHand(const plants::DriveRatings& ratings)
      : stage({.per_torque_squared = 1, .resistance = 1}, {}, ratings, plants::AmplifierData{10, 30, 3}, {}) {
  }
  void drive(double) override {}
  void sense(double) override {}
  void visit(StateArchive& /*archive*/) override {}
  std::vector<plants::DriveOfPlant> drives() override { return {{"servo", &stage, 0.01, 1}}; }
  plants::Shaft rotor;
  plants::PowerStage stage;
};

/// Its judge, as a run tells it: record instants every 2 ms, and events.
struct ByHand {
  static constexpr Time step = 100 * microsecond;
  scenario::Scenario scenario;
  TurnedByHand axis;
  std::unique_ptr<DriveJudge> judge;
  Time now = 0;

  static plants::DriveRatings ratings() {
    return {.rotor_inertia = 0.01,
            .stall_torque = 10,
            .rated_torque = 10,
            .peak_torque = 30,
            .torque_at_max_speed = 30,
            .rated_speed = 200,
            .max_speed = 300};
  }
  explicit ByHand(double cycle, const plants::DriveRatings& rated = ratings()) : axis(rated) {
    scenario.drives.cycle = static_cast<Time>(std::llround(cycle * static_cast<double>(second)));
    judge = std::make_unique<DriveJudge>(scenario, std::vector<NamedPlant>{{"axis", &axis}});
  }
  /// So long with such a torque [N m], from a speed to another [rad/s]; `asked`: over the torque limit.
  void run(double time, double torque, double from = 0, double to = 0, double asked = 0) {
    const auto steps = std::lround(time / seconds(step));
    for (long i = 0; i < steps; ++i) {
      axis.rotor.speed_before = from + (to - from) * static_cast<double>(i) / static_cast<double>(steps);
      axis.rotor.speed = from + (to - from) * static_cast<double>(i + 1) / static_cast<double>(steps);
      axis.stage.account({torque, 0, asked, true}, axis.rotor, seconds(step));
      now += step;
      for (const auto& event : axis.stage.take_events()) {
        record::RecordedEvent told{now, 0, "axis", std::string(event.name), {}, ""};
        for (const auto& value : event.values)
          told.values.push_back({std::string(value.name), value.number, std::string(value.unit)});
        judge->happened(told);
      }
      if (now % (2 * millisecond) == 0) judge->sample(now);
    }
  }
  /// Up, along, down, and a rest: 1.2 s. `more`: times the torque.
  void move(double more = 1) {
    run(0.2, 12 * more, 0, 100);
    run(0.3, 2 * more, 100, 100);
    run(0.2, -8 * more, 100, 0);
    run(0.5, 1 * more);
  }
  static double rms_of_move() { return std::sqrt((144 * 0.2 + 4 * 0.3 + 64 * 0.2 + 1 * 0.5) / 1.2); }
  void cut() { judge->happened({now, 0, "axis", "cut", {}, ""}); }
  [[nodiscard]] record::DriveVerdict verdict() const { return judge->verdicts().at(0); }
  [[nodiscard]] record::CheckResult check() const { return judge->results(judge->verdicts()).at(0); }
};

// However many moves a run has, whether home was searched before them, and how long it stands before and
// after.
TEST(DriveJudge, TheLoadOfACycleIsThatOfTheMoveFromAnyNumberOfThem) {
  for (const auto& [homing, cycle] : {std::pair{false, "1.2 s"}, {true, "1.2 s"}, {true, "1.21 s"}})
    for (const int moves : {2, 3, 12}) {
      SCOPED_TRACE(testing::Message()
                   << moves << " moves" << (homing ? " behind a search of home" : "") << ", named " << cycle);
      ByHand hand(std::stod(cycle));
      hand.run(0.7, 1);
      if (homing) {
        hand.run(0.25, 3, 20, 20);
        hand.run(0.37, 1);
      }
      for (int i = 0; i < moves; ++i) hand.move();
      hand.run(3, 1);
      const auto verdict = hand.verdict();
      EXPECT_TRUE(verdict.steady);
      EXPECT_THAT(verdict.notes, testing::IsEmpty());
      const auto& rms = figure(verdict, "rms torque");
      EXPECT_TRUE(rms.judged);
      EXPECT_NEAR(rms.value, ByHand::rms_of_move(), 5e-3 * ByHand::rms_of_move());
      EXPECT_NEAR(figure(verdict, "rms current, for the winding").value, rms.value, 1e-9);
      EXPECT_EQ(rms.window, moves == 12 ? "worst 10 cycles in a row" : "steady cycle");
      EXPECT_EQ(verdict.cycles, std::to_string(moves + (homing ? 1 : 0)) + " cycles of " + cycle);
    }
}

TEST(DriveJudge, AHeavierCycleSinceTheSteadyOneIsWhatCounts) {
  ByHand hand(1.2);
  for (const double more : {1.0, 1.0, 1.3, 1.2}) hand.move(more);
  EXPECT_FALSE(hand.verdict().steady);
  EXPECT_EQ(figure(hand.verdict(), "rms torque").window, "heaviest cycle");
  EXPECT_NEAR(figure(hand.verdict(), "rms torque").value, 1.3 * ByHand::rms_of_move(), 0.02);
  EXPECT_THAT(hand.verdict().notes, ElementsAre(HasSubstr("its heaviest cycle counts, of 4 cycles")));
  hand.move(1.2);
  EXPECT_TRUE(hand.verdict().steady);
  EXPECT_NEAR(figure(hand.verdict(), "rms torque").value, 1.2 * ByHand::rms_of_move(), 0.02);
}

TEST(DriveJudge, WithoutASteadyCycleTheRunSaysSo) {
  ByHand hand(1.2);
  for (const double more : {1.0, 1.05, 1.0, 1.05}) hand.move(more);
  EXPECT_FALSE(hand.verdict().steady);
  EXPECT_EQ(figure(hand.verdict(), "rms torque").window, "mean of 4 cycles");
  EXPECT_THAT(hand.verdict().notes,
              ElementsAre(HasSubstr("axis.servo: no steady cycle in 4 cycles of 1.2 s")));
  hand.move(1.055);  // within 1 %
  EXPECT_TRUE(hand.verdict().steady);
  EXPECT_NEAR(figure(hand.verdict(), "rms torque").value, 1.055 * ByHand::rms_of_move(), 0.02);
  EXPECT_THAT(hand.verdict().notes, testing::IsEmpty());
}

TEST(DriveJudge, WithoutACycleTheVerdictSaysThatHeatIsNotJudgedAndWarnsOfWhatWouldBeTooMuch) {
  const std::string remedy = "axis.servo: heat is not judged, for no machine cycle is known; name its length";
  ByHand cool(0);
  cool.run(5, 1);
  for (int i = 0; i < 3; ++i) cool.move();
  EXPECT_TRUE(cool.check().passed);
  EXPECT_THAT(cool.verdict().notes, ElementsAre(HasSubstr(remedy)));
  EXPECT_THAT(cool.verdict().warnings, testing::IsEmpty());
  // Standstill before the first motion is in no mean.
  EXPECT_NEAR(figure(cool.verdict(), "rms torque").value, ByHand::rms_of_move(), 5e-3);

  ByHand hot(0);
  hot.run(5, 1);
  for (int i = 0; i < 3; ++i) hot.move(2);
  EXPECT_TRUE(hot.check().passed);
  EXPECT_THAT(hot.verdict().notes, testing::IsEmpty());
  ASSERT_EQ(hot.verdict().warnings.size(), 1U);
  EXPECT_THAT(hot.verdict().warnings[0],
              testing::AllOf(HasSubstr(remedy), HasSubstr("rms torque would be 120 %")));

  ByHand long_cycle(200);
  for (int i = 0; i < 3; ++i) long_cycle.move();
  EXPECT_THAT(long_cycle.verdict().notes,
              ElementsAre(HasSubstr("drives.cycle, 200.0 s, is longer than the run")));
}

// Counting noise makes each cycle another one; ten of them are the machine's work all the same.
TEST(DriveJudge, TenUnevenCyclesAreKnownWhenFiveAreAsTheFiveBefore) {
  ByHand hand(1.2);
  for (int i = 0; i < 5; ++i)
    for (const double more : {1.0, 1.05, 0.95, 1.03}) hand.move(more);
  EXPECT_TRUE(hand.verdict().steady);
  EXPECT_THAT(figure(hand.verdict(), "rms torque").window, "worst 10 cycles in a row");
}

TEST(DriveJudge, FromCutToCutTheSteadyCycleStandsForTooFewOfThem) {
  ByHand hand(0);
  hand.run(1, 1);
  hand.run(0.3, 25, 20, 20);  // the search of home
  for (int i = 0; i < 5; ++i) {
    hand.cut();
    hand.move();
  }
  EXPECT_EQ(hand.verdict().cycles, "3 cycles from cut to cut");
  EXPECT_EQ(figure(hand.verdict(), "rms torque").window, "steady cycle");
  EXPECT_NEAR(figure(hand.verdict(), "rms torque").value, ByHand::rms_of_move(), 5e-3);
  EXPECT_EQ(figure(hand.verdict(), "peak torque").window, "from the first cut on");
  EXPECT_NEAR(figure(hand.verdict(), "peak torque").value, 12, 1e-9);
}

TEST(DriveJudge, ADriveThatIsClippedFailsWithoutACycleToo) {
  ByHand hand(0);
  hand.run(1, 1);
  for (int i = 0; i < 4; ++i) {
    hand.run(0.2, 30, 0, 100, 1.3);
    hand.run(0.2, -30, 100, 0, 1.2);
    hand.run(0.6, 0);
  }
  const auto check = hand.check();
  EXPECT_FALSE(check.passed);
  EXPECT_THAT(check.detail,
              HasSubstr("time at the torque limit 40 of 1 % (4000 %, from the first motion on)"));
  EXPECT_EQ(figure(hand.verdict(), "peak torque").share, 1);

  // An inverter's ramp waits at its limit, a motor on the mains passes its pull-out torque at each start.
  auto inverter = ByHand::ratings();
  inverter.works_at_limit = true;
  ByHand works(0, inverter);
  for (int i = 0; i < 4; ++i) {
    works.run(0.2, 30, 0, 100, 1.3);
    works.run(0.2, -30, 100, 0, 1.2);
    works.run(0.6, 0);
  }
  EXPECT_TRUE(works.check().passed) << works.check().detail;
  EXPECT_FALSE(figure(works.verdict(), "peak torque").judged);
  EXPECT_NE(works.verdict().tightest().name, "peak torque");
  EXPECT_NE(works.verdict().tightest().name, "time at the torque limit");
}

TEST(DriveJudge, ALimitThatActedBeforeTheFirstCutIsTold) {
  ByHand hand(0);
  hand.run(0.8, 1);
  hand.run(0.05, 30, 10, 20, 1.5);
  hand.run(0.1, 1, 20, 20);
  hand.run(0.03, -30, 20, 0, 1.5);
  hand.run(0.1, 1);
  for (int i = 0; i < 13; ++i) {
    hand.cut();
    hand.move();
  }
  const auto check = hand.check();
  EXPECT_TRUE(check.passed) << check.detail;
  EXPECT_EQ(hand.verdict().limit_elsewhere, "2 times, 0.08 s in all, first at 0.800 s");
  EXPECT_THAT(check.detail,
              HasSubstr("; outside of these cycles at its torque limit 2 times, 0.08 s in all"));
  EXPECT_NEAR(figure(hand.verdict(), "peak torque").value, 12, 1e-9);
}

TEST(DriveJudge, ATripIsToldInWordsAndHasNoMargin) {
  for (const auto& [event, words] :
       {std::pair{"bus_overvoltage", "axis.servo: tripped by overvoltage at 0.500 s"},
        {"bus_undervoltage", "axis.servo: tripped by undervoltage at 0.500 s"},
        {"overload", "axis.servo: tripped by overload at 0.500 s"},
        {"pulled_out", "axis.servo: pulled out at 0.500 s"}}) {
    ByHand hand(1.2);
    hand.run(0.5, 1, 10, 10);
    hand.judge->happened({hand.now, 0, "axis", event, {}, ""});
    const auto check = hand.check();
    EXPECT_FALSE(check.passed);
    EXPECT_EQ(check.detail, words);
    EXPECT_FALSE(check.margin);
  }
}

/// On every plant with a drive what the mains gave is found again: in work, heat, the resistor, the link.
struct Machine {
  std::string scene;
  std::string motor;  ///< channels of its motor
};
class EnergyOfDrives : public testing::TestWithParam<Machine> {};

TEST_P(EnergyOfDrives, ClosesAndItsWorkIsThatOfItsSteps) {
  const auto& [scene, motor] = GetParam();
  Line line(scene, {{"scene.duration", "6 s"}});
  auto& simulation = *line.simulation;
  const auto torque = simulation.names().reading(motor + ".torque").value();
  const auto speed = simulation.names().reading(motor + ".speed").value();
  constexpr double rpm = 2 * std::numbers::pi / 60;
  const double h = seconds(line.scenario.scene.step);
  double work = 0;
  double before = speed.read();
  while (simulation.time() < line.scenario.scene.duration) {
    ASSERT_TRUE(simulation.advance());
    work += torque.read() * 0.5 * (before + speed.read()) * rpm * h;
    before = speed.read();
  }
  for (const auto& [name, plant] : simulation.plants())
    for (const auto& drive : plant->drives()) {
      if (name + ".motor" != motor) continue;
      const auto& totals = drive.stage->totals();
      const auto& link = drive.stage->link();
      const double stored =
          link ? link->stored() - link->data().capacitance * link->data().voltage * link->data().voltage : 0;
      EXPECT_GT(totals.copper, 0);
      EXPECT_NEAR(totals.from_mains, totals.work + totals.copper + totals.in_resistor + stored,
                  1e-6 * (std::abs(totals.from_mains) + totals.copper));
      EXPECT_NEAR(totals.work, work, 2e-3 * (std::abs(work) + totals.copper)) << "up to five steps behind";
    }
}

INSTANTIATE_TEST_SUITE_P(Plants, EnergyOfDrives,
                         testing::Values(Machine{"rotary_knife.yaml", "knife.motor"},
                                         Machine{"rotary_knife_corrugated_500.yaml", "knife.motor"},
                                         Machine{"flying_saw_2m.yaml", "saw.motor"},
                                         Machine{"flying_saw_lx3vp_2m.yaml", "saw.motor"},
                                         Machine{"backlash_motor_encoder.yaml", "axis.motor"},
                                         Machine{"press_learning.yaml", "press.motor"},
                                         Machine{"onoff_backlash.yaml", "axis.motor"}),
                         [](const auto& name) {
                           auto text = name.param.scene.substr(0, name.param.scene.find('.'));
                           return text;
                         });

}  // namespace
}  // namespace drycut::sim::loop
