// Slips of a new user in the lines that `drycut new` makes: each is told once, at its place, with what to do.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/text.hpp"
#include "sim/cli/check_command.hpp"
#include "sim/cli/new_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;

/// In a file of a line one text is written in place of another. Where `to` has an @ stands what is told; the
/// @ itself is not written.
struct Slip {
  std::string file;
  std::string from;
  std::string to;
  std::string told;   ///< words of the problem, in their order, "..." between them
  bool note = false;  ///< it is a note, and the file is sound
};

bool has_in_order(std::string_view text, std::string_view words) {
  while (!words.empty()) {
    const auto end = std::min(words.find("..."), words.size());
    const auto at = text.find(words.substr(0, end));
    if (at == std::string_view::npos) return false;
    text.remove_prefix(at + end);
    words.remove_prefix(std::min(end + 3, words.size()));
  }
  return true;
}

struct Slips : CommandTest {
  void make(const std::string& machine, const std::string& controller) {
    ASSERT_EQ(captured([&] { return make_line({folder / "line", machine, controller}); }), all_passed) << err;
  }

  void check_all(const std::vector<Slip>& slips) {
    for (const auto& slip : slips) {
      SCOPED_TRACE(slip.file + ": " + slip.to);
      const auto file = folder / "line" / slip.file;
      const auto sound = content(file);
      const auto at = sound.find(slip.from);
      ASSERT_NE(at, std::string::npos) << slip.from;
      auto text = sound;
      text.replace(at, slip.from.size(), slip.to);
      const auto mark = text.find('@', at);
      ASSERT_LT(mark, at + slip.to.size()) << "no @";
      text.erase(mark, 1);
      std::ofstream(file) << text;
      const auto line_start = text.rfind('\n', mark - 1) + 1;
      expect_told(slip, fmt::format("{}:{}:{}: ", file.string(),
                                    1 + std::count(text.begin(),
                                                   text.begin() + static_cast<std::ptrdiff_t>(mark), '\n'),
                                    mark - line_start + 1));
      std::ofstream(file) << sound;
    }
  }

  void expect_told(const Slip& slip, const std::string& place) {
    CheckOptions check;
    check.files = {folder / "line/line.yaml"};
    EXPECT_EQ(captured([&] { return check_files(check); }), slip.note ? all_passed : bad_input);
    const auto lines = split_lines(slip.note ? out : err);
    // And how many there are; a wire that is refused makes no lamp, which checks then miss.
    ASSERT_GE(lines.size(), 2U) << out << err;
    EXPECT_LE(lines.size(), slip.note ? 2U : 3U) << out << err;
    EXPECT_NE(lines[0].find(place), std::string_view::npos) << place << '\n' << lines[0];
    EXPECT_TRUE(has_in_order(lines[0], slip.told)) << lines[0];
  }

  TestFolder folder;
};

TEST_F(Slips, InTheScenarioOfAKnife) {
  make("rotary_knife", "qmove");
  const std::string y = "line.yaml";
  check_all({
      {y, "speed: 60.4 m/min", "speed: 60.4 @m/mn", "unknown unit 'm/mn'; did you mean m/min?"},
      {y, "length: 800 mm ", "length: @0.8 ", "without a unit; it is used as a length...write 0.8 m"},
      {y, "length: 800 mm ", "length: 800 @mmm ", "unknown unit 'mmm'; did you mean mm?"},
      {y, "  length: 800 mm", "  @lenght: 800 mm", "'lenght' is not used...did you mean length?"},
      {y, "duration: 16 s", "duration: @16", "no unit, but this is a time; write 16 s"},
      {y, "type: rotary_knife", "type: @rotary_knive", "did you mean rotary_knife?"},
      {y, "rotary_knife\n    web: web", "rotary_knife\n    web: @wbe", "no plant 'wbe'; name one of: web"},
      {y, "circumference: 600 mm", "@circumferenz: 600 mm", "did you mean circumference?"},
      {y, "600 mm\n    gear", "600 mm\n    initial_angle: @180\n    gear",
       "no unit, but this is an angle; write 180 deg"},
      {y, "thickness: 0.5 mm", "thickness: @0,5 mm", "has a decimal comma; write 0.5 mm"},
      {y, "0 m/min, thickness: 0.5", "0 m/min thickness@: 0.5", "write a comma before 'thickness'"},
      {y, "programs/rotary_knife.cnf", "@programs/rotary_knife.cfn", "did you mean rotary_knife.cnf?"},
      {y, "[programs/rotary_knife.mod]", "[@programs/rotary_knife.cnf]",
       "is a QMOVE configuration...controller.qmove.configuration takes it"},
      {y, "CNT01: knife.encoder", "CNT01: @knife.encodr", "no plug 'encodr'; did you mean knife.encoder?"},
      {y, "2.CNT01: knife.encoder", "@2.CTN01: knife.encoder", "no"},
      {y, "2.CNT01: knife.encoder", "@2.CNT01 knife.encoder", "no colon in '2.CNT01 knife.encoder'"},
      {y, "2.AN01:", "@2.AN02:", "uses no 2.AN02; its analogue output terminals are: 2.AN01"},
      {y, "2.OUT02: panel.cutting", "@2.OUT01: panel.cutting", "'2.OUT01' is given twice"},
      {y, "2.OUT01: panel.in_sync", "2.OUT01: @knife.home", "digital output, knife.home is a signal"},
      {y, "at: 2 s, ramp", "at: @2, ramp", "no unit, but this is a time; write 2 s"},
      {y, "ramp: {web.speed: \"${speed}\"}, over: 2 s", "@ramp: {web.speed: \"${speed}\"}", "add over: 1 s"},
      {y, "{when: gbPhase", "{@whn: gbPhase", "unknown key 'whn'...did you mean when?"},
      {y, "gbPhase == 2", "gbPhase @= 2", "'=' does not compare; write =="},
      {y, "when: gbPhase == 2", "when: @gbFase == 2", "did you mean gbPhase?"},
      {y, "{when: gbPhase == 2", "{@at: 1 s, when: gbPhase == 2", "both at and when; keep one; from:"},
      {y, "{panel.start: 1}", "{@panel.strat: 1}", "did you mean panel.start?"},
      {y, "ramp: {web.speed:", "ramp: {@web.sped:", "did you mean web.speed?"},
      {y, "web.speed: \"${speed}\"", "web.speed: @60", "web.speed needs a unit; write for example 60 m/min"},
      {y, "web.speed: \"${speed}\"", "web.speed: $@{speed}", "stands in quotes"},
      {y, "web.speed: \"${speed}\"", "web.speed: \"@${sped}\"", "did you mean speed?"},
      {y, "[AxisX.posit,", "[@AxisX.pos,", "did you mean AxisX.posit?"},
      {y, "every: 2 ms", "every: @2.05 ms", "multiple of scene.step 100 us; for example 2 ms"},
      {y, "each: cut", "each: @cutt", "did you mean cut?"},
      {y, "abs(length", "abs(@lenght", "did you mean length?"},
      {y, "<= 0.2 mm", "<= @0.2 kg", "is a mass...is a length; write it in mm"},
      {y, "<= 0.2 mm", "@=< 0.2 mm", "'=<' does not compare; write <="},
      {y, "{name: cut length, each: cut, from: 7 s", "{name: @cut length, each: cut, from: 70 s",
       "begins at 70 s, and the run ends at 16 s"},
      {y, "name: blade at web speed in the cut", "name: @cut length", "two checks named 'cut length'"},
      {y, "follerr < 100", "follerr <@", "ends where a value must follow"},
      {y, "always: AxisX.follerr", "@alway: AxisX.follerr", "unknown key 'alway'...did you mean always?"},
      {y, "title: Rotary knife, pieces", "title: Rotary knife@: pieces", "stands in quotes"},
      {y, "scene:\n  title", "scene:\n@\ttitle", "a tab in the indentation"},
      {y, "\nwiring:", "\n@wirings:", "did you mean wiring?"},
      {y, "camera: knife", "camera: @nife", "no camera 'nife'; cameras: operator, web, knife"},
      {y, "size: 960x540", "size: @960*540", "in pixels without blanks: 960x540"},
      {y, "set: {slLength:", "set: {@slLenght:", "did you mean slLength?"},
      {y, "slLength: \"${length} / 0.1 mm\"", "@slLength: 8000.5", "holds whole numbers, not 8000.5"},
      {y, "  qmove:", "  @qmov:", "known: qmove, lx3vp, plcopen"},
  });
}

TEST_F(Slips, InTheConfigurationOfAKnife) {
  make("rotary_knife", "qmove");
  const std::string c = "programs/rotary_knife.cnf";
  check_all({
      {c, "CAMMING4", "@CAMING4", "did you mean 'CAMMING4'?"},
      {c, "slLength    L ", "slLength    @LL ", "the type is F, B, W, L or S"},
      {c, "2 1MIXA 00", "2 @1MIXA", "no firmware number"},
      {c, "BUS\n1 1CPUB 02", "@BUS", "BUS has no CPU card"},
      {c, "2.CNT01 2.CNT02", "2.CNT01 @2.CNT09", "no card has so many"},
      {c, "F 2.INP03", "F @2.OUT03", "not the address of a digital input"},
      {c, "2.AN01 2.OUT01", "2.AN01 @2.OUT02", "'2.OUT02' is taken already; the first stands in line"},
      {c, "CAMMING4 2 ", "CAMMING4 @0 ", "sampling time in ms, from 1 to"},
      {c, "X.X     1 ", "X.X     @9 ", "an interrupt line from 1 to 8"},
      {c, "glRow       L", "@gbPhase     L", "declared twice"},
      {c, "cCutZone    600", "cCutZone    @60,5", "is not a number"},
      {c, "GLOBAL", "@GLOABL", "did you mean 'GLOBAL'?"},
  });
}

TEST_F(Slips, InTheQclOfAKnife) {
  make("rotary_knife", "qmove");
  const std::string m = "programs/rotary_knife.mod";
  check_all({
      {m, "AxisX:measure ", "AxisX:@mesure ", "did you mean 'measure'?"},
      {m, "measure  =", "measure  @:=", "there is no ':='; '=' assigns"},
      {m, "pgain EQ 0", "pgain @= 0", "EQ compares"},
      {m, "ENDIF\n\nINIT", "@END_IF\n\nINIT", "did you mean 'ENDIF'?"},
      {m, "st_prsok", "@st_prsk", "did you mean 'st_prsok'?"},
      {m, "START AxisX", "START @AxisY", "did you mean 'AxisX'?"},
      {m, "JUMP MAIN", "JUMP @MIAN", "did you mean 'MAIN'?"},
      {m, "CALL Program", "CALL @Programm", "did you mean 'Program'?"},
      {m, "gbPhase = 1", "AxisX:@st_toll = 1", "only the device changes it"},
      {m, "gbPhase = 1", "@gbPhase = 300", "300 does not fit size B, taken as 44", true},
      {m, "gbPhase = 1", "@ifStart = 1", "is an input and cannot be assigned"},
      {m, "AxisX:toll     = 5", "AxisX:@toll     = 0.03", "whole numbers: 0.03 is taken as 0", true},
      {m, "AxisX:feedfw = 1000", "AxisX:@feedfw = 999.9", "whole numbers: 999.9 is taken as 999", true},
      {m, "AxisX:pgain  = 50", "AxisX:@pgain  = -5", "from 0 to 32767, and -5 is outside", true},
      {m, "WAIT 1\n", "WAIT 1 @ms\n", "WAIT takes a condition, not a time; start a TIMER"},
      {m, "REGON AxisX", "@REGON", "write REGON Device"},
      {m, "REGON AxisX", "@REGONN AxisX", "did you mean 'REGON'?"},
      {m, "REGON AxisX\n", "REGON AxisX @// on\n", "comments after ';'"},
      {m, "gbPhase = 3\n", "gbPhase @3\n", "expected '='"},
  });
}

TEST_F(Slips, InTheInstructionListOfAKnife) {
  make("rotary_knife", "lx3vp");
  const std::string i = "programs/rotary_knife.il";
  check_all({
      {i, "LD      X14", "LD      @X18", "not octal"},
      {i, "MOV     K400 D512", "MOV     @K70000 D512", "wider than 16 bits; use the 32-bit instruction"},
      {i, "DMOV    K20000", "@DMOVE   K20000", "did you mean DMOV?"},
      {i, "OUT     M12", "@OUT", "has 1 operand, not 0"},
      {i, "OUT     M12", "OUT     @X15", "does not take X15"},
      {i, "M15 Y0 Y4", "M15 @Y0", "has 5 operands, not 4"},
      {i, "LD      X14", "LD      @M8035", "M8035 is not simulated; there are"},
      {i, "DEMOV   E1.6666666 D506", "DEMOV   @1.6666 D506", "K10, H1F or E1.5"},
      {i, "DEMOV   E1.6666666 D506", "DEMOV   E1,@6666 D506", "E1,6666 has a decimal comma; write E1.6666"},
      {i, "MOV     K1 D1005", "MOV     K1 D1005\nLD X14\nSET @M12", "M12 has SET here and OUT in line 37",
       true},
      {i, "MOV     K1 D1005", "MOV     K1 D1005\nLD X14\nOUT @M12",
       "M12 has OUT here and OUT in line 37: the last in a scan decides", true},
      {i, "K100 D1000", "@K102 D1000", "ECAMTBX has no type K102; write K0, K1, K100 or K101", true},
      {i, "DMOV    K20000 D502", "DMOV    K20000 @D50200", "does not exist; there are D0 to"},
      {"line.yaml", "D102: 1, D103: 1}", "D102: 1, D103: 1, @D512: 300}",
       "D512 = 300, and the program's first scan makes it 400", true},
      {"line.yaml", "C251: web.wheel", "C251: web.wheel\n  @X18: panel.x", "X0 to X377...(octal)"},
  });
}

TEST_F(Slips, InTheStructuredTextOfAKnife) {
  make("rotary_knife", "plcopen");
  const std::string t = "programs/rotary_knife.st";
  const std::string y = "line.yaml";
  check_all({
      {t, "state := Fault;", "state @= Fault;", "':=' assigns"},
      {t, "state := Fault;", "state := Fault@", "';' is missing"},
      {t, "state := Fault;", "state := @Fautl;", "did you mean 'Fault'?"},
      {t, "state := Fault;\nEND_IF", "state := Fault;\n@ENDIF", "did you mean 'END_IF'?"},
      {t, "state := Fault;\nEND_IF", "state := Fault;\n@END IF", "did you mean 'END_IF'?"},
      {t, "Brake(Axis := Knife, Execute", "Brake(Axis := Knife, @Execut", "did you mean 'Execute'?"},
      {t, "Away : MC_MoveVelocity;", "Away : @MC_MoveVelocty;", "did you mean 'MC_MoveVelocity'?"},
      {t, "30_000.0;", "30_000@,0;", "a decimal comma; write 30_000.0"},
      {t, "start AT %IX0.0", "start AT @%IX0.9", "bit 0 to 7"},
      {t, "mcShortestWay", "@mcShortest", "did you mean 'mcShortestWay'?"},
      {t, "failure := Register.failure;", "failure := @rest;", "LREAL_TO_UDINT(...) converts"},
      {t, "IF Edge.Done THEN", "IF Edge.Done @== TRUE THEN", "there is no '=='; '=' compares"},
      {t, "IF Edge.Done THEN", "IF Edge.@Don THEN", "did you mean 'Done'?"},
      {t, "// 1 mm/s", "@# 1 mm/s", "comments are (* ... *) or //"},
      {t, "homed := TRUE;", "@SLOW := 1.0;", "'SLOW' is a constant"},
      {y, "path: [360 deg, 40960]", "path: @[360 deg 40960]", "write [500 mm, 10000]"},
      {y, "kv: 60 1/s", "kv: @60", "60 without a unit, in 0.01/s: 0.6 1/s; write 60 1/s", true},
      {y, "feed_forward: 100 %", "feed_forward: @100", "in 0.1 %: 10 %; write 100 %", true},
      {y, "is_master: on", "is_master: @yes", "write on or off"},
      {y, "[cams/knife.tab]", "[@cams/knif.tab]", "did you mean knife.tab?"},
      {y, "Knife.encoder: knife", "@Knive.encoder: knife", "did you mean Knife?"},
      {y, "IX0.2: knife.home", "@IX1.2: knife.home", "its inputs are: IX0.0"},
      {y, "[acknowledge]", "[@acknowlege]", "did you mean acknowledge?"},
      {y, "at: 100 ms", "at: 100 @m", "is a time, not a length (m)"},
  });
}

TEST_F(Slips, InASawAndAPress) {
  make("vertical_press", "qmove");
  check_all({
      {"line.yaml", "tours: 4 ", "tours: @3.5 ", "is 3.5, and a whole number is needed"},
      {"line.yaml", "load: 0 kg", "load: @0 N", "is a force (0 N); it is used as a mass...write 0 kg"},
      {"line.yaml", "drive: contactors", "drive: @contactor", "did you mean contactors?"},
      {"line.yaml", "Axis.dobiner: 1", "@Axis.dobiner: 2", "write 0 to 1"},
      {"line.yaml", "Axis.maxiner: 1000", "@Axis.maxiner: 10.5", "holds whole numbers, not 10.5"},
  });
}

// What takes a counter's terminal away from the wiring is told where it was, too.
TEST_F(Slips, ACounterOfTwoFieldsIsToldInTheConfiguration) {
  make("rotary_knife", "qmove");
  const auto file = folder / "line/programs/rotary_knife.cnf";
  auto text = content(file);
  text.replace(text.find("2.CNT01 2.CNT02"), 15, "2.CNT01 2.CNT01");
  std::ofstream(file) << text;
  CheckOptions check;
  check.files = {folder / "line/line.yaml"};
  EXPECT_EQ(captured([&] { return check_files(check); }), bad_input);
  EXPECT_THAT(err,
              testing::HasSubstr("rotary_knife.cnf:31:31: CountS and CountMA of AxisX are the same counter"));
}

}  // namespace
}  // namespace drycut::sim::cli
