// The list of cells that are accepted.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "sim/studies/faults/accept.hpp"

namespace drycut::sim::studies {
namespace {

class AcceptedFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    const auto file = std::filesystem::path(testing::TempDir()) / "cells.yaml";
    std::ofstream(file) << text;
    return file;
  }
};

FaultMoment moment(const std::string& name, std::optional<double> phase = {}) {
  FaultMoment made;
  made.name = name;
  made.phase = phase;
  return made;
}

TEST_F(AcceptedFile, NamesFaultsMomentsAndKinds) {
  Problems problems;
  const auto entries =
      read_accepted(write("- {fault: \"knife.encoder.*\", when: 20..45 %, cell: wrong, why: a note}\n"
                          "- {fault: \"*\", when: at knife.*, cell: damage, why: another}\n"),
                    problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(entries.size(), 2U);
  const TriedFault lost{"knife.encoder", "lose_counts", 2000, ""};
  const TriedFault home{"knife.home", "stuck", 1, ""};
  FaultCell wrong;
  wrong.kind = FaultCell::Kind::wrong;
  EXPECT_TRUE(entries[0].covers(lost, moment("45 %", 45), wrong));
  EXPECT_FALSE(entries[0].covers(lost, moment("46 %", 46), wrong));
  EXPECT_FALSE(entries[0].covers(home, moment("45 %", 45), wrong));
  EXPECT_FALSE(entries[0].covers(lost, moment("45 %", 45), FaultCell{})) << "it is unharmed";
  EXPECT_FALSE(entries[1].covers(home, moment("at knife.cut"), wrong)) << "only damage is accepted";
  auto broken = wrong;
  broken.kind = FaultCell::Kind::damage;
  EXPECT_TRUE(entries[1].covers(home, moment("at knife.cut"), broken));
}

TEST_F(AcceptedFile, IsRefusedAtItsPlaces) {
  Problems problems;
  read_accepted(write("- {fault: a, when: b, cell: told, why: c}\n- {fault: a, when: b, cell: wrong}\n"
                      "- {fault: a, when: b, cell: wrong, why: c, who: d}\n- none\n"),
                problems);
  ASSERT_EQ(problems.size(), 4U);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_EQ(problems[i].code, "faults.bad-entry"_code);
    EXPECT_EQ(problems[i].line, static_cast<int>(i) + 1);
  }
  problems.clear();
  read_accepted(write("fault: a\n"), problems);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].code, "faults.bad-entry"_code);
}

}  // namespace
}  // namespace drycut::sim::studies
