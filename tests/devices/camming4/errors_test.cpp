#include <gmock/gmock.h>

#include "devices/camming4/messages.hpp"
#include "tests/devices/camming4/covers.hpp"
#include "tests/devices/camming4/fixture.hpp"

namespace drycut::devices::camming4 {
namespace {

using testing::Contains;

class Camming4Errors : public Camming4Test {
 protected:
  void load_constant() { rows({{132, 100, 50}, {133, 1000, 1000}, {137, 2}}); }
};

TEST_F(Camming4Errors, AnErrorBlocksTheAxisUntilRserrAndResume) {
  rows({{132, 100, 50}, {77, 100, 100}});
  after("INIT LOOPON forget STARTCAM +11*10", "error errcode=3 errvalue=2 emrg !camex DAC=0");
  says({"st_error: error 3 in row 2: no such G code"});
  row(2, {136});
  after("RESUME STARTCAM", "!camex");
  EXPECT_THAT(diagnostics(), Contains("STARTCAM: st_error is 1, must be 0"));
  after("RSERR", "errcode=0 errvalue=0");
  after("STARTCAM", "camex");
  covers({"error 3"});
}

TEST_F(Camming4Errors, RserrLeavesTheEmergency) {
  row(1, {77});
  after("INIT LOOPON STARTCAM", "errcode=3");
  after("RSERR", "!error emrg");
  after("STARTCAM", "!camex");
  after("RESUME", "!emrg");
}

TEST_F(Camming4Errors, AWriteIntoTheRunningRowIsErrorFive) {
  load_constant();
  after("INIT LOOPON STARTCAM +5*10 codeQs2=1000 +1*10", "!error");
  after("forget codeQs1=60 +1*10", "errcode=5 errvalue=1 codeQs1=50");
  EXPECT_THAT(diagnostics(), Contains("codeQs1: needs rowex != n, or gearing"));
  covers({"error 5"});
}

TEST_F(Camming4Errors, LeavingTheSyncRangeIsWarningTwelve) {
  load_constant();
  after("syncrange=20 INIT LOOPON STARTCAM", "sync");
  does("blocked=1");
  while (get("follerr") < 20) {
    shows("sync !warning");
    does("+1*2");
  }
  after("+2*2", "!sync wrncode=12 wrnvalue=1");
  covers({"warning 12", "syncrange"});
}

TEST_F(Camming4Errors, WarningsKeepTheHighestPriority) {
  after("INIT LOOPON STOP", "wrncode=11");
  // Warning 6 (priority 2) replaces 11, then 5 (priority 9) does not replace 6 [D33].
  rows({{132, 100, 50}, {132, 100, 50}, {133, 100, -100}, {136}});
  after("STARTCAM +25*5", "wrncode=6 wrnvalue=2");
  after("+20*5", "rowex=3 wrncode=6");
  after("RSWRN", "!warning wrncode=0 wrnvalue=0");
  covers({"warning 6"});
}

TEST_F(Camming4Errors, TheSameWarningOfAnotherRowIsTheNewOne) {
  rows({{154, 100, 100}, {133, 100, 40}, {154, 100, 100}, {133, 100, 40}, {136}});
  after("INIT LOOPON STARTCAM +30*5", "wrncode=5 wrnvalue=2");
  after("+40*5", "wrncode=5 wrnvalue=4");
}

TEST_F(Camming4Errors, WatchesTheGradientLimits) {
  // 0 to 1 over 100 Um at 5000 Um/s: 250000 Um/s2. From rest to maxvel in 0.2 s.
  load_constant();
  after("taccmax=20 INIT LOOPON +20*10 STARTCAM! +1*10", "!warning");
  after("EMRG RESUME taccmax=21 +20*10 STARTCAM! +1*10", "wrncode=1 wrnvalue=1");
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
  rows(GetParam().rows);
  after("INIT LOOPON STARTCAM +60*10", "error");
  EXPECT_EQ(get("errcode"), GetParam().code);
  EXPECT_EQ(get("errvalue"), GetParam().row);
  shows("emrg !camex DAC=0");
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
  rows({{132, 100, 50}, {137, 128}});
  row(128, {77});
  after("INIT LOOPON STARTCAM +20*10", "errcode=3 errvalue=128");
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
