#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "devices/device.hpp"

// The public face of CAMMING4 (000 1.9; spec qem.md 8.1-8.3, with the print's slips corrected as D16 and D19
// say).
namespace drycut::devices::camming4::table {

using R = Retention;

inline constexpr std::array states_rows = {
    State{"st_init", R::zero, "the device is initialised and runs"},
    State{"st_chvel", R::zero, "a new setvel would act on the running movement"},
    State{"st_emrg", R::zero, "emergency: no reaction, no movement, output 0 V"},
    State{"st_toll", R::zero, "the last placement ended within toll of its quota"},
    State{"st_tpos", R::zero, "posit is within toll of setpos, whatever was started"},
    State{"st_prson", R::zero, "the slave's preset search runs"},
    State{"st_prsok", R::zero, "the slave's count has been preset"},
    State{"st_prsonm", R::zero, "the master's preset search runs"},
    State{"st_prsokm", R::zero, "the master's count has been preset"},
    State{"st_still", R::one, "no positioning movement runs; stays 1 in a cam"},
    State{"st_camex", R::zero, "a cam runs"},
    State{"st_movdir", R::zero, "direction of the last positioning movement, 1 = backward"},
    State{"st_loopon", R::zero, "the position loop is closed"},
    State{"st_foller", R::zero, "following error above maxfollerr, held for 500 ms"},
    State{"st_sync", R::zero, "in a cam and the following error is within syncrange"},
    State{"st_cal", R::zero, "calibration: the output is the voltage vout"},
    State{"st_cntlock", R::retentive, "the slave's count is locked"},
    State{"st_cntrev", R::retentive, "the slave's count is reversed"},
    State{"st_cntlockm", R::retentive, "the master's count is locked"},
    State{"st_cntrevm", R::retentive, "the master's count is reversed"},
    State{"st_regoff", R::zero, "regulation off: the DAC keeps its word, movements are refused"},
    State{"st_enbl", R::zero, "the function of the normal input is armed"},
    State{"st_intenbl", R::zero, "the function of the interrupt input is armed"},
    State{"st_capt", R::zero, "the function of the normal input has run"},
    State{"st_intcapt", R::zero, "the function of the interrupt input has run"},
    State{"st_int", R::zero, "level of the interrupt line InGInt"},
    State{"st_error", R::zero, "an error stopped the axis; errcode and errvalue say which"},
    State{"st_warning", R::zero, "a warning stands; wrncode and wrnvalue say which"},
    State{"st_acc", R::zero, "a positioning movement accelerates"},
    State{"st_dec", R::zero, "a positioning movement decelerates"},
    State{"st_vconst", R::zero, "a positioning movement runs at constant speed"},
};
inline constexpr auto states = in_section("000 1.9.6", states_rows);

inline constexpr Needs<states> needs;
inline constexpr Turns<states, false> turns;
inline constexpr Turns<states, true> turns_quietly;  ///< where it holds already: a silent no-op

inline constexpr Condition initialised = needs({"st_init"});
/// Resolution and speed scale may change while nothing moves.
inline constexpr Condition at_rest = needs({"st_still", "!st_camex", "!st_prson"});

inline constexpr std::array commands_rows = {
    command("INIT", needs({"!st_init"}), "computes the parameters and starts the device"),
    command("EMRG", initialised, "stops everything without ramp, opens the reaction, output 0 V",
            turns("st_emrg")),
    command("RESUME", needs({"st_init", "st_emrg"}), "ends the emergency; the axis reacts where it stands",
            turns_quietly("!st_emrg")),
    command("STOP", needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "!st_still", "!st_camex"}),
            "ends a positioning movement with the ramp tdec"),
    command("START",
            needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "st_still", "!st_camex", "!st_prson"}),
            "places the slave at setpos with setvel"),
    command(
        "PRESET",
        needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "!st_camex"}, "st_still = 1 or st_prson = 1"),
        "starts the slave's preset search; while it runs, turns its direction"),
    command("RSPRSOK", needs({"st_init", "!st_prson"}), "clears st_prsok", turns("!st_prsok")),
    command("PRESETM", needs({"st_init", "!st_camex", "!st_prsonm"}), "starts the master's preset search"),
    command("RSPRSM", initialised, "clears st_prsokm, or ends the master's preset search"),
    command("RSERR", initialised, "clears st_error, errcode, errvalue; the emergency stays",
            turns("!st_error")),
    command("RSWRN", initialised, "clears st_warning, wrncode, wrnvalue", turns("!st_warning")),
    command("LOOPON", needs({"st_init", "!st_loopon"}),
            "closes the position loop; the following error becomes 0", turns_quietly("st_loopon")),
    command("LOOPOFF", needs({"st_init", "st_loopon"}), "opens the position loop without stopping the axis",
            turns_quietly("!st_loopon")),
    command("MANFW",
            needs({"st_init", "!st_regoff", "!st_prson", "!st_camex", "!st_cal", "st_still", "!st_emrg"}),
            "runs forward at setvel until STOP, at most to maxpos"),
    command("MANBW",
            needs({"st_init", "!st_regoff", "!st_prson", "!st_camex", "!st_cal", "st_still", "!st_emrg"}),
            "runs backward at setvel until STOP, at most to minpos"),
    command("CALON", initialised, "makes the output a voltage source set by vout; ends any movement",
            turns_quietly("st_cal")),
    command("CALOFF", needs({"st_init", "st_cal"}), "ends calibration; the axis reacts where it stands",
            turns_quietly("!st_cal")),
    command("CNTLOCK", initialised, "stops counting the slave's transducer", turns("st_cntlock")),
    command("CNTUNLOCK", initialised, "counts the slave's transducer again", turns("!st_cntlock")),
    command("CNTREV", initialised, "reverses the slave's counting direction", turns("st_cntrev")),
    command("CNTDIR", initialised, "restores the slave's counting direction", turns("!st_cntrev")),
    command("CNTLOCKM", initialised, "stops counting the master's transducer", turns("st_cntlockm")),
    command("CNTUNLOCKM", initialised, "counts the master's transducer again", turns("!st_cntlockm")),
    command("CNTREVM", initialised, "reverses the master's counting direction", turns("st_cntrevm")),
    command("CNTDIRM", initialised, "restores the master's counting direction", turns("!st_cntrevm")),
    command("STOPCAM", needs({"st_init", "st_camex"}, "25 ms since a start by input function 11 or 12"),
            "leaves the master at once and stops with the ramp tdec"),
    command("STARTCAM",
            needs({"st_init", "st_still", "!st_camex", "!st_prson", "!st_emrg", "!st_regoff", "!st_error",
                   "!st_cal"}),
            "starts the cam at row 1, origin where master and slave are"),
    command("REGOFF", needs({"st_init", "st_still", "!st_camex", "!st_prson"}),
            "turns regulation off: the DAC keeps its word", turns_quietly("st_regoff")),
    command("REGON", needs({"st_init", "st_still", "st_regoff", "!st_emrg"}),
            "turns regulation on; the axis reacts where it stands", turns_quietly("!st_regoff")),
    command("ENBL", initialised, "arms the function of the normal input; inpcapt says its edge",
            turns("st_enbl")),
    command("INTENBL", initialised, "arms the function of the interrupt input; intcapt says its edge",
            turns("st_intenbl")),
    command("DSBL", initialised, "disarms the function of the normal input", turns("!st_enbl")),
    command("INTDSBL", needs({"st_init"}, "intcapt > 0"), "disarms the function of the interrupt input",
            turns("!st_intenbl")),
    command("RSCAPT", needs({"st_init", "st_capt"}), "clears st_capt", turns_quietly("!st_capt")),
    command("RSINTCAPT", needs({"st_init", "st_intcapt"}), "clears st_intcapt", turns_quietly("!st_intcapt")),
    command("DELCNT", needs({"st_init", "st_still", "!st_camex", "!st_prson", "!st_cal", "!st_regoff"}),
            "adds delta1 [Um] to posit, remainder kept"),
    command("DELCNTM", needs({"st_init", "!st_prsonm", "!st_camex"}),
            "adds delta2 [Um] to positm, remainder kept"),
};
inline constexpr auto commands = in_section("000 1.9.5", commands_rows);

inline constexpr std::array parameters_rows = {
    kept("decpt", Size::B, "", 0, 3, at_rest,
         "decimals of the slave's unit of measure: speeds are in whole units"),
    kept("measure", Size::L, "Um", 1, 999999, at_rest,
         "slave space in which its transducer gives `pulse` bits"),
    kept("pulse", Size::L, "bits x4", 1, 999999, at_rest, "slave transducer bits in the space `measure`"),
    kept("measurem", Size::L, "Um", 1, 999999, at_rest,
         "master space in which its transducer gives `pulsem` bits"),
    kept("pulsem", Size::L, "bits x4", 1, 999999, at_rest, "master transducer bits in the space `measurem`"),
    kept("unitvel", Size::B, "", 0, 1, at_rest, "time unit of speeds: 0 per minute, 1 per second"),
    kept("maxvel", Size::L, "speed", 0, 999999, at_rest, "slave speed at an output of 10 V"),
    kept("prsvel", Size::L, "speed", 0, 999999, needs({"!st_prson"}),
         "speed of the preset search toward the enable input, up to maxvel"),
    kept("sprsvel", Size::L, "speed", 0, 999999, needs({"!st_prson"}),
         "speed of the preset search's slow leg, up to prsvel"),
    kept("taccmax", Size::W, "1/100 s", 0, 999, needs({"!st_prson"}),
         "shortest time from rest to maxvel in a cam, else warning 1; 0 = not watched"),
    kept("tdecmax", Size::W, "1/100 s", 0, 999, needs({"!st_prson"}),
         "shortest time from maxvel to rest in a cam, else warning 2; 0 = not watched"),
    kept("tacc", Size::W, "1/100 s", 0, 999, "acceleration time from rest to maxvel"),
    kept("tdec", Size::W, "1/100 s", 0, 999, "deceleration time from maxvel to rest"),
    kept("maxpos", Size::L, "Um", -999999, 999999, needs({"st_still"}),
         "largest quota of placements and manual movements"),
    kept("minpos", Size::L, "Um", -999999, 999999, needs({"st_still"}),
         "smallest quota of placements and manual movements"),
    kept("prspos", Size::L, "Um", -999999, 999999, needs({"st_still"}),
         "quota that the slave's preset search loads, minpos..maxpos"),
    kept("prsposm", Size::L, "Um", -999999, 999999, needs({"!st_prsonm"}),
         "quota that the master's preset search loads"),
    kept("toll", Size::L, "Um", 0, 999999, needs({"st_still"}),
         "largest distance from the quota for st_toll and st_tpos"),
    kept("maxfollerr", Size::L, "bits x4", 0, highest, "following error above which st_foller is reported"),
    kept("syncrange", Size::L, "Um", 0, 9999999, "following error up to which st_sync is reported in a cam"),
    kept("prsmode", Size::B, "", 0, 2, needs({"!st_prson"}),
         "slave preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable without "
         "search"),
    kept("prsmodem", Size::B, "", 0, 2, needs({"!st_prsonm"}),
         "master preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable without "
         "search"),
    kept("prsdir", Size::B, "", 0, 1, needs({"!st_prson"}),
         "first direction of the slave's preset search: 0 forward, 1 backward"),
    kept("mtype", Size::B, "", 0, 1,
         "master in use: 0 CountMA, 1 CountMB; may change in a cam, positm does not jump"),
    kept("ramptype", Size::B, "", 0, 1, needs({"st_still"}),
         "ramps of positioning: 0 trapezoidal, 1 epicycloidal"),
    kept("rtype", Size::B, "", 0, 1, "short epicycloidal movements: 0 keep ramp times, 1 keep gradients"),
    kept("stopt", Size::B, "", 0, 1,
         "STOP in an epicycloidal acceleration: 0 ends the ramp first, 1 decelerates at once"),
    kept("pgain", Size::W, "1/1000", 0, 32767,
         "proportional gain: 1000 gives 10 V at the way of maxvel in one TCamp"),
    kept("feedfw", Size::W, "1/1000", 0, 32767,
         "feed-forward: 1000 gives 10 V at the theoretical speed maxvel"),
    kept("integt", Size::W, "ms", 0, 32767, "integration time, smaller is stronger, 0 = off"),
    kept("derivt", Size::W, "ms", 0, 32767, "derivative time, larger is stronger, 0 = off"),
    kept("offset", Size::W, "DAC bits", -32767, 32767,
         "added to the output always while the device drives it"),
    kept("tbfm", Size::W, "", 0, 3, "window of frqm: 0 240 ms, 1 480 ms, 2 24 ms, 3 120 ms"),
    kept("tbf", Size::W, "", 0, 3, "window of frq and vel: 0 240 ms, 1 480 ms, 2 24 ms, 3 120 ms"),
};
inline constexpr auto parameters = in_section("000 1.9.2", parameters_rows);

inline constexpr std::array values_rows = {
    zeroed(
        "frqm", Size::L, "Hz", lowest, highest,
        "frequency of one phase of the master's transducer; what is written stays to the end of its window"),
    kept("positm", Size::L, "Um", -999999, 999999, needs({"st_init", "!st_camex"}), "master's position"),
    kept("encoderm", Size::L, "bits x4", lowest, highest, needs({"st_init", "!st_camex"}),
         "master's position"),
    zeroed("vout", Size::B, "0.1 V", -100, 100, needs({"st_init", "st_cal"}),
           "output voltage: set in calibration, shown otherwise"),
    shown("follerr", "bits x4", "magnitude of theoretical minus actual position"),
    shown("vel", "speed", "magnitude of the slave's speed, from frq's window"),
    shown("frq", "Hz", "frequency of one phase of the slave's transducer"),
    kept("posit", Size::L, "Um", -999999, 999999, needs({"st_init", "!st_camex"}), "slave's position"),
    kept("encoder", Size::L, "bits x4", lowest, highest, needs({"st_init", "!st_camex"}), "slave's position"),
    kept("delta1", Size::L, "", lowest, highest, "what DELCNT adds; register of the input functions"),
    kept("delta2", Size::L, "", lowest, highest, "what DELCNTM adds; register of the input functions"),
    kept("setvel", Size::L, "speed", 0, 999999, "speed of placements and manual movements, up to maxvel"),
    kept("setpos", Size::L, "Um", -999999, 999999, "quota of placements, minpos..maxpos"),
    shown("rowex", Size::W, "", 0, 128, "running row of the cam table, 0 = no cam"),
    shown("ffwdreg", "DAC bits", "feed-forward action"),
    shown("propreg", "DAC bits", "proportional action"),
    shown("intreg", "DAC bits", "integral action"),
    shown("derreg", "DAC bits", "derivative action"),
    shown("codeMex", "", "codeM of the running movement row, 0 without a cam"),
    elsewhere("000 1.7", kept("funInp", Size::B, "", 0, 99, "function of the normal input InG")),
    elsewhere("000 1.7", kept("funInt", Size::B, "", 0, 99, "function of the interrupt input InGInt")),
    elsewhere("000 1.8", kept("funOut", Size::B, "", 0, 99, "function of the output Out")),
    zeroed("inpcapt", Size::B, "", 0, 2,
           "edge of the normal input that runs funInp: 0 none, 1 falling, 2 rising"),
    zeroed("intcapt", Size::B, "", 0, 2,
           "edge of the interrupt input that runs funInt: 0 none, 1 falling, 2 rising"),
    elsewhere("000 1.3", shown("errcode", Size::B, "", 0, 100, "error that stopped the axis")),
    elsewhere("000 1.3", shown("errvalue", Size::B, "", 0, 128, "row that caused the error")),
    elsewhere("000 1.4", shown("wrncode", Size::B, "", 0, 100, "standing warning of the highest priority")),
    elsewhere("000 1.4", shown("wrnvalue", Size::B, "", 0, 128, "row that caused the warning")),
};
inline constexpr auto values = in_section("000 1.9.3", values_rows);

/// The cam table: a row each.
inline constexpr std::array cam_table_rows = {
    kept("codeG", Size::W, "", -128, 254, needs({}, "rowex != n"),
         "operating instruction of the row; -128..-1 act as 128..255"),
    kept("codeQm", Size::L, "Um", -159154, 999999, needs({}, "rowex != n"),
         "master's part of the row: space, ratio, radius, row or count, as codeG says"),
    kept("codeQs", Size::L, "Um", -999999, 999999, needs({}, "rowex != n, or gearing"),
         "slave's part of the row: space, ratio, displacement or count, as codeG says"),
    kept("codeQma", Size::L, "Um", 0, 999999, needs({}, "rowex != n"),
         "master's auxiliary part of the row; read-out of 170..175 and 190"),
    kept("codeQsa", Size::L, "bits x4", -999999, 999999, needs({}, "rowex != n, or gearing"),
         "slave's auxiliary part of the row"),
    kept("codeM", Size::L, "", lowest, highest, needs({}, "rowex != n"),
         "number for the program, shown in codeMex while the row runs"),
};
inline constexpr auto cam_table = in_section("000 1.9.4", of_rows(128, cam_table_rows));

inline constexpr auto variables = joined(joined(parameters, values), cam_table);

inline constexpr std::array fields = {
    Field{"TCamp", Field::Kind::period_ms, 1, 250, "sampling time [ms]"},
    Field{"CountS", Field::Kind::counter, 0, 0, "slave's transducer"},
    Field{"CountMA", Field::Kind::counter, 0, 0, "master A's transducer"},
    Field{"CountMB", Field::Kind::counter, 0, 0, "master B's transducer"},
    Field{"IntL", Field::Kind::interrupt_line, 1, 8, "slave's zero pulse"},
    Field{"IAZero", Field::Kind::input, 0, 0, "enable of the slave's preset"},
    Field{"IntLM", Field::Kind::interrupt_line, 1, 8, "master's zero pulse"},
    Field{"IAZeroM", Field::Kind::input, 0, 0, "enable of the master's preset"},
    Field{"InG", Field::Kind::input, 0, 0, "normal input, function funInp"},
    Field{"InGInt", Field::Kind::interrupt_line, 1, 8, "interrupt input, function funInt"},
    Field{"IoutA", Field::Kind::analogue, 0, 0, "slave's speed reference"},
    Field{"Out", Field::Kind::output, 0, 0, "output, function funOut"},
};

/// Where the manual of CAMMING4 leaves something open, and what the device does there (spec qem.md 10).
inline constexpr std::array readings = {
    ManualReading{"",
                  "commands wait for the next sample, which takes them as a set in the order of the table",
                  "000 1.9.5 gives the commands in an order, no mechanism"},
    ManualReading{
        "",
        "recalculations of several writes follow each other: their samples add up; a row of the cam, measure "
        "and pulse, measurem and pulsem, decpt and unitvel are one each; an event waits for those before it",
        "000 1.4 gives the samples of a single parameter"},
    ManualReading{"", "9 rows without master space, 4 update rows in a sequence, one more is error 1",
                  "000 1.2.11 and 1.2.12 say 9 and 4, 1.10 says 7 and 3"},
    ManualReading{
        "", "138 takes off the space done but for what a gearing has taken off itself",
        "000 1.2.9 and 1.2.13 take off the space done, 1.2.3.2 the laps of a gearing; none names both"},
    ManualReading{"integt",
                  "the integral action grows by the proportional action of pgain 1000 in each integt",
                  "000 1.1.12.3 gives the direction of the effect, no scale"},
    ManualReading{
        "derivt",
        "the derivative action is the error's change in derivt, scaled as pgain 1000 scales the error",
        "000 1.1.12.4 gives the direction of the effect, no scale"},
    ManualReading{"maxpos", "written with st_still = 1",
                  "000 1.9.2 prints st_still = 0, which no sound program could use"},
    ManualReading{"minpos", "written with st_still = 1",
                  "000 1.9.2 prints st_still = 0, which no sound program could use"},
    ManualReading{"prspos", "written with st_still = 1",
                  "000 1.9.2 prints st_still = 0, which no sound program could use"},
    ManualReading{"toll", "written with st_still = 1",
                  "000 1.9.2 prints st_still = 0, which no sound program could use"},
    ManualReading{
        "ramptype", "of placements; written with st_still = 1",
        "000 1.9.2 prints st_still = 0 and calls cam fittings trapezoidal, 1.2 has the codes 231..254"},
    ManualReading{"taccmax", "0 = not watched", "000 1.9.2: the printed descriptions are shifted by a row"},
    ManualReading{"tdecmax", "0 = not watched", "000 1.9.2: the printed descriptions are shifted by a row"},
    ManualReading{
        "prsmode", "2 loads as long as the enable is on, once it was off since INIT",
        "000 1.9.2 says 'to the activation' in the words of 002 1.4.3, which 002 1.2.5.4 explains so"},
    ManualReading{"prsmodem", "2 loads at the enable's edge, and the master counts on from there",
                  "000 1.9.2 says 'to the activation'; what 002 1.2.5.4 explains is a slave's"},
    ManualReading{"mtype", "the increments come from the new counter, positm does not jump",
                  "000 1.5 allows the change in a cam, and says no more"},
    ManualReading{"rowex", "0..128", "000 1.9.3 prints 0..40, of an earlier device of 40 sectors"},
    ManualReading{"setpos", "a START beyond minpos..maxpos goes to the limit, and says so",
                  "000 1.9.3 gives the range, no answer to a quota outside"},
    ManualReading{"codeG", "a byte of -128..-1 is a code of 128..255; 129th row: error 6, value 128",
                  "000 1.1.14 keeps codes in a byte, and says nothing of a cam without end"},
    ManualReading{"codeQm", "in gearing positm wraps at codeQm, posit at codeQs",
                  "000 1.2.3 says so, its table fixes them at half"},
    ManualReading{
        "codeQs",
        "132 and 150..153 whose space does not fit their speeds take two ramps, broken at half of the "
        "master's space; 235 always takes two cycloids",
        "000 1.2.1..1.2.3 ask for a compensation and do not give its law"},
    ManualReading{
        "codeQma",
        "softening of n = 1..4 is a ramp of 1/(n+1) of the smaller sector on both sides of the boundary",
        "000 1.2.3 gives the fractions, the picture is lost"},
    ManualReading{
        "codeQsa",
        "175 and 174 turn the tangent in degrees; 180 adds its way by a trapezoid of setvel, tacc, tdec, "
        "whatever ramptype says",
        "000 1.2.4 names no unit, 1.2.12 no profile"},
    ManualReading{"wrncode", "a warning gives way to one of its own priority or a higher one",
                  "000 1.4 calls the number a priority, and says no more"},
    ManualReading{
        "EMRG", "leaves the output alone while st_regoff = 1",
        "000 1.1.6.1 makes it 0 V, 1.9.6 does not update the DAC of an axis whose regulation is off"},
    ManualReading{
        "follerr",
        "the loop's error has fractions of a bit; st_foller and st_sync go by the whole bits of follerr",
        "000 1.9.3 gives follerr in bits, and nothing says what the loop works on"},
    ManualReading{"START", "needs st_still = 1", "000 1.9.5 prints st_still = 0"},
    ManualReading{"STARTCAM", "needs st_camex = 0",
                  "000 1.9.5 prints st_camex = 1, 1.1.5.1 forbids it in a cam"},
    ManualReading{"STOPCAM", "stops with a straight ramp whatever ramptype says",
                  "000 1.1.5.3 names tdec alone, 1.9.2 gives ramptype to placements and not to the cam"},
    ManualReading{"LOOPON", "a silent no-op where the loop is closed", "000 1.9.5 prints st_loopon = 1"},
    ManualReading{"CALOFF", "a silent no-op where there is no calibration",
                  "000 1.9.5 prints st_cal = 0; the start-up program of 1.1.1.1 gives it without"},
    ManualReading{"PRESETM", "needs st_prsonm = 0", "000 1.9.5 prints st_prson, the slave's"},
    ManualReading{
        "RSPRSM", "needs st_init = 1, and no more",
        "000 1.9.5 prints st_init = 0 and st_prson = 0, the slave's; its text ends a search of the master's "
        "and clears what that found"},
    ManualReading{
        "PRESET",
        "needs st_still = 1, or turns a running search; with the enable already on, it begins with its "
        "slow leg, reversed",
        "000 1.9.5 prints st_still = 0; the search is described in 002 1.2.5, with the enable off"},
    ManualReading{"ENBL", "arms the normal input", "000 1.9.5 prints the text of CNTREV here"},
    ManualReading{"INTENBL", "arms the interrupt input", "000 1.9.5 prints the text of CNTDIR here"},
    ManualReading{"DSBL", "disarms the normal input", "000 1.9.5 prints the text of CNTLOCKM here"},
    ManualReading{"frqm", "what is written stays to the end of its window",
                  "000 1.9.3 prints RdWr for a measured value"},
    ManualReading{
        "st_toll",
        "goes by the quota of the last START until a manual movement, a search or a cam that leaves it",
        "000 1.9.6 names that quota and not what ends it; 1.9.2 toll excludes the arrival in a cam"},
    ManualReading{"st_still", "stays 1 while a cam runs", "000 1.9.6: the sentence lost its object"},
    ManualReading{"st_sync", "the following error in a cam is at most syncrange; leaving that is warning 12",
                  "000 1.9.2 and 1.4 give no measure of synchronism but syncrange"},
};

}  // namespace drycut::devices::camming4::table

namespace drycut::devices::camming4 {

inline constexpr DeviceType camming4_type = {
    "CAMMING4",
    "analogue slave axis: positioner and cam generator of 128 sectors",
    table::variables,
    table::states,
    table::commands,
    table::fields,
    {},
    table::readings,
};

using VariableRow = NamedRow<camming4_type, &DeviceType::variables>;

}  // namespace drycut::devices::camming4
