#include <gmock/gmock.h>

#include "devices/camming4/messages.hpp"
#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;
using testing::ElementsAre;

class Camming4Errors : public Camming4Test {
 protected:
  void load_constant() {
    row(1, {132, 100, 50});
    row(2, {133, 1000, 1000});
    row(3, {137, 2});
  }
};

TEST_F(Camming4Errors, AnErrorBlocksTheAxisUntilRserrAndResume) {
  row(1, {132, 100, 50});
  row(2, {77, 100, 100});
  start();
  diagnostics();
  command("STARTCAM");
  ticks(11, 10);
  EXPECT_EQ(get("st_error"), 1);
  EXPECT_EQ(get("errcode"), 3);
  EXPECT_EQ(get("errvalue"), 2);
  EXPECT_EQ(get("st_emrg"), 1);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(word(), 0);
  EXPECT_THAT(diagnostics(), ElementsAre("st_error: error 3 in row 2: no such G code"));
  row(2, {136});
  command("RESUME");
  command("STARTCAM");
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_THAT(diagnostics(), Contains("STARTCAM: st_error is 1, must be 0"));
  command("RSERR");
  EXPECT_EQ(get("errcode"), 0);
  EXPECT_EQ(get("errvalue"), 0);
  command("STARTCAM");
  EXPECT_EQ(get("st_camex"), 1);
  covers({"error 3", "errcode", "errvalue", "st_error", "RSERR accepted", "STARTCAM accepted"});
}

TEST_F(Camming4Errors, RserrLeavesTheEmergency) {
  row(1, {77});
  start();
  command("STARTCAM");
  EXPECT_EQ(get("errcode"), 3);
  command("RSERR");
  EXPECT_EQ(get("st_error"), 0);
  EXPECT_EQ(get("st_emrg"), 1);
  command("STARTCAM");
  EXPECT_EQ(get("st_camex"), 0);
  command("RESUME");
  EXPECT_EQ(get("st_emrg"), 0);
}

TEST_F(Camming4Errors, AWriteIntoTheRunningRowIsErrorFive) {
  load_constant();
  start();
  command("STARTCAM");
  ticks(5, 10);
  write("codeQs2", 1000);
  tick(10);
  EXPECT_EQ(get("st_error"), 0);
  diagnostics();
  write("codeQs1", 60);
  tick(10);
  EXPECT_EQ(get("errcode"), 5);
  EXPECT_EQ(get("errvalue"), 1);
  EXPECT_EQ(get("codeQs1"), 50);
  EXPECT_THAT(diagnostics(), Contains("codeQs1: needs rowex != n, or gearing"));
  covers({"error 5"});
}

TEST_F(Camming4Errors, LeavingTheSyncRangeIsWarningTwelve) {
  load_constant();
  set({{"syncrange", 20}});
  start();
  command("STARTCAM");
  EXPECT_EQ(get("st_sync"), 1);
  slave_blocked = true;
  while (get("follerr") < 20) {
    EXPECT_EQ(get("st_sync"), 1);
    EXPECT_EQ(get("st_warning"), 0);
    tick(2);
  }
  ticks(2, 2);
  EXPECT_EQ(get("st_sync"), 0);
  EXPECT_EQ(get("wrncode"), 12);
  EXPECT_EQ(get("wrnvalue"), 1);
  covers({"warning 12", "syncrange", "st_sync"});
}

TEST_F(Camming4Errors, WarningsKeepTheHighestPriority) {
  start();
  command("STOP");
  EXPECT_EQ(get("wrncode"), 11);
  // Warning 6 (priority 2) replaces 11, then 5 (priority 9) does not replace 6 [D33].
  row(1, {132, 100, 50});
  row(2, {132, 100, 50});
  row(3, {133, 100, -100});
  row(4, {136});
  command("STARTCAM");
  ticks(25, 5);
  EXPECT_EQ(get("wrncode"), 6);
  EXPECT_EQ(get("wrnvalue"), 2);
  ticks(20, 5);
  EXPECT_EQ(get("rowex"), 3);
  EXPECT_EQ(get("wrncode"), 6);
  command("RSWRN");
  EXPECT_EQ(get("st_warning"), 0);
  EXPECT_EQ(get("wrncode"), 0);
  EXPECT_EQ(get("wrnvalue"), 0);
  covers({"RSWRN accepted", "wrncode", "wrnvalue", "st_warning", "warning 6"});
}

TEST_F(Camming4Errors, TheSameWarningOfAnotherRowIsTheNewOne) {
  row(1, {154, 100, 100});
  row(2, {133, 100, 40});
  row(3, {154, 100, 100});
  row(4, {133, 100, 40});
  row(5, {136});
  start();
  command("STARTCAM");
  ticks(30, 5);
  EXPECT_EQ(get("wrncode"), 5);
  EXPECT_EQ(get("wrnvalue"), 2);
  ticks(40, 5);
  EXPECT_EQ(get("wrncode"), 5);
  EXPECT_EQ(get("wrnvalue"), 4);
}

TEST_F(Camming4Errors, WatchesTheGradientLimits) {
  // 0 to 1 over 100 Um at 5000 Um/s: 250000 Um/s2. From rest to maxvel in 0.2 s.
  load_constant();
  set({{"taccmax", 20}});
  start();
  ticks(20, 10);
  order("STARTCAM");
  tick(10);
  EXPECT_EQ(get("st_warning"), 0);
  command("EMRG");
  command("RESUME");
  write("taccmax", 21);
  ticks(20, 10);
  order("STARTCAM");
  tick(10);
  EXPECT_EQ(get("wrncode"), 1);
  EXPECT_EQ(get("wrnvalue"), 1);
  covers({"warning 1", "taccmax"});
}

struct TableError {
  const char* name;
  std::vector<std::vector<std::int32_t>> rows;
  int code;
  int row;
};

class Camming4TableErrors : public Camming4Test, public testing::WithParamInterface<TableError> {};

TEST_P(Camming4TableErrors, BlockTheAxis) {
  int number = 1;
  for (const auto& values : GetParam().rows) {
    static constexpr const char* columns[] = {"codeG", "codeQm", "codeQs", "codeQma", "codeQsa"};
    for (std::size_t i = 0; i < values.size(); ++i) write(columns[i] + std::to_string(number), values[i]);
    ++number;
  }
  start();
  command("STARTCAM");
  ticks(60, 10);
  EXPECT_EQ(get("st_error"), 1);
  EXPECT_EQ(get("errcode"), GetParam().code);
  EXPECT_EQ(get("errvalue"), GetParam().row);
  EXPECT_EQ(get("st_emrg"), 1);
  EXPECT_EQ(get("st_camex"), 0);
  EXPECT_EQ(word(), 0);
  covers({"error " + std::to_string(GetParam().code), "errcode", "errvalue", "st_error"});
}

INSTANTIATE_TEST_SUITE_P(
    Each, Camming4TableErrors,
    testing::Values(TableError{"zero_space_run", std::vector<std::vector<std::int32_t>>(12, {130}), 1, 10},
                    TableError{"update_run", std::vector<std::vector<std::int32_t>>(6, {140, 5}), 1, 5},
                    TableError{"jump_onto_a_start", {{132, 100, 50}, {137, 1}}, 2, 1},
                    TableError{"no_code", {{132, 100, 50}, {1, 2, 3}}, 3, 2},
                    TableError{"no_space", {{131, 0, 50}}, 4, 1},
                    TableError{"shorter_than_a_sample", {{132, 92, 46}, {133, 5, 5}}, 4, 2},
                    TableError{"jump_out_of_the_table", {{132, 100, 50}, {137, 129}}, 6, 2},
                    TableError{"late_start_sector", {{132, 100, 50}, {160, 400}}, 7, 2},
                    TableError{"radius_too_small", {{170, 10, 15, 0, 33}}, 50, 1},
                    TableError{"arc_without_space", {{170, 10, 0, 0, 0}}, 51, 1}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST_F(Camming4Errors, NamesRowOneHundredTwentyEight) {
  row(1, {132, 100, 50});
  row(2, {137, 128});
  row(128, {77});
  start();
  command("STARTCAM");
  ticks(20, 10);
  EXPECT_EQ(get("errcode"), 3);
  EXPECT_EQ(get("errvalue"), 128);
  covers({"errvalue"});
}

TEST(Camming4Messages, HaveThePrioritiesOfTheManual) {
  // 000 1.4
  constexpr int priorities[] = {6, 7, 4, 5, 9, 2, 8, 0, 1, 10, 11, 3};
  int code = 1;
  for (const int priority : priorities) {
    EXPECT_EQ(warning_priority(code), priority) << code;
    EXPECT_FALSE(warning_text(code).empty()) << code;
    ++code;
  }
  EXPECT_TRUE(warning_text(0).empty());
  EXPECT_TRUE(warning_text(13).empty());
  for (const int error : {1, 2, 3, 4, 5, 6, 7, 50, 51}) EXPECT_FALSE(error_text(error).empty()) << error;
  EXPECT_TRUE(error_text(8).empty());
}

}  // namespace
}  // namespace drycut::devices::camming4
