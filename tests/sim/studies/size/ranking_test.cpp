// The order of a sizing, and what the row of a point keeps of a drive.
#include <gmock/gmock.h>

#include <cmath>

#include "sim/studies/size/study.hpp"

namespace drycut::sim::studies {
namespace {

Candidate motor(const std::string& name, double power, double resistor = 0) {
  Candidate made;
  made.motor = name;
  made.rated_power = power;
  made.resistor_power = resistor;
  return made;
}
Sized short_by(double percent, std::size_t unknown = 0, std::size_t corners = 1) {
  Sized made;
  made.kind = Sized::Kind::does_not_fit;
  made.reserve = NAN;
  made.distance = {unknown, percent, "rms torque", "a corner", corners};
  return made;
}
Sized result(Sized::Kind kind, double reserve, double energy = 1) {
  Sized made;
  made.kind = kind;
  made.reserve = reserve;
  made.energy = energy;
  return made;
}

TEST(SizeRanking, IsTheOrderThatIsStated) {
  using Kind = Sized::Kind;
  auto heavy = motor("heavy", 1);
  heavy.inertia_ratio = 30;
  heavy.most_inertia_ratio = 10;
  auto less_heavy = heavy;
  less_heavy.motor = "less heavy";
  less_heavy.inertia_ratio = 11;
  const std::vector<Candidate> candidates = {motor("cannot", 1),
                                             heavy,
                                             less_heavy,
                                             motor("nobody knows", 1),
                                             motor("far", 1),
                                             motor("near", 9),
                                             motor("not short", 9),
                                             motor("near twice", 1),
                                             motor("close", 1),
                                             motor("large", 3),
                                             motor("small", 2, 100),
                                             motor("less", 2, 100),
                                             motor("hungry", 2, 100),
                                             motor("warm", 2, 200)};
  const std::vector<Sized> sized = {result(Kind::ruled_out, NAN, NAN),
                                    result(Kind::ruled_out, NAN, NAN),
                                    result(Kind::ruled_out, NAN, NAN),
                                    short_by(2, 1),
                                    short_by(50),
                                    short_by(5),
                                    short_by(0),
                                    short_by(5, 0, 2),
                                    result(Kind::close, 9),
                                    result(Kind::fits, 80),
                                    result(Kind::fits, 30),
                                    result(Kind::fits, 20),
                                    result(Kind::fits, 30, 2),
                                    result(Kind::fits, 90)};
  std::vector<std::string> names;
  for (const auto i : ranked(candidates, sized)) names.push_back(candidates[i].motor);
  EXPECT_THAT(names,
              testing::ElementsAre("small", "hungry", "less", "warm", "large", "close", "not short", "near",
                                   "near twice", "far", "nobody knows", "less heavy", "heavy", "cannot"));
}

// A row has every figure that the judge judges, and gives it back.
TEST(RatedDrive, GoesThereAndBack) {
  record::DriveVerdict verdict;
  for (const auto& [name, unit, mean] : ratings)
    verdict.figures.push_back({std::string(name), 2, 4, std::string(unit), 0.5});
  verdict.figures[0].judged = false;
  verdict.figures[1].value = 3;
  verdict.inertia_ratio = 3.5;
  verdict.energy = 7;
  verdict.steady = true;
  verdict.trips = {"overload at 1 s"};
  verdict.cycle_points = {{10, 1}, {11, 5}, {12, 2}};
  verdict.points = {{0, 1}, {0, -2}, {24, 5}, {12, 3}, {12, 4}};
  const auto numbers = rated_numbers(verdict);
  EXPECT_EQ(numbers.size(), rated_columns("knife.servo").size());
  auto row = std::vector<double>{1, 2, 3};
  row.insert(row.end(), numbers.begin(), numbers.end());
  const auto drive = rated_drive(row);
  EXPECT_TRUE(std::isnan(drive.figures[0].share));
  EXPECT_EQ(drive.figures[1].value, 3);
  EXPECT_EQ(drive.figures[1].share, 0.5);
  EXPECT_EQ(drive.inertia_ratio, 3.5);
  EXPECT_EQ(drive.energy, 7);
  EXPECT_EQ(drive.trips, 1);
  EXPECT_EQ(drive.cycles, 3);
  EXPECT_EQ(drive.steady, 1);
  EXPECT_EQ(drive.rms, (std::pair<double, double>(11, 5)));
  EXPECT_EQ(drive.outline[0], (std::pair<double, double>(0, 1)));
  EXPECT_EQ(drive.outline[1], (std::pair<double, double>(0, -2)));
  EXPECT_EQ(drive.outline[24], (std::pair<double, double>(12, 4)));
  EXPECT_EQ(drive.outline[25], (std::pair<double, double>(12, 3)));
  EXPECT_EQ(drive.outline[46], (std::pair<double, double>(24, 5)));
  EXPECT_TRUE(std::isnan(drive.outline[2].first));
  verdict.figures.push_back({"colour", 1, 1, "", 1});
  EXPECT_THROW(rated_numbers(verdict), std::logic_error);
}

}  // namespace
}  // namespace drycut::sim::studies
