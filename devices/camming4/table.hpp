#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "devices/device.hpp"

namespace drycut::devices::camming4 {

// The public face of CAMMING4 (000 1.9; spec qem.md 8.1-8.3, with the print's slips corrected as D16 and D19
// say).

namespace table {

using R = Retention;
using enum Access;

/// Number of the row called `name`; a name that is not in the table does not compile.
template <typename Rows>
consteval int row_of(const Rows& rows, std::string_view name) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return static_cast<int>(i);
  throw "no such row";
}

inline constexpr std::array states = {
    State{"st_init", R::zero, "the device is initialised and runs", "000 1.9.6"},
    State{"st_chvel", R::zero, "a new setvel would act on the running movement", "000 1.9.6"},
    State{"st_emrg", R::zero, "emergency: no reaction, no movement, output 0 V", "000 1.9.6"},
    State{"st_toll", R::zero, "the last placement ended within toll of its quota", "000 1.9.6"},
    State{"st_tpos", R::zero, "posit is within toll of setpos, whatever was started", "000 1.9.6"},
    State{"st_prson", R::zero, "the slave's preset search runs", "000 1.9.6"},
    State{"st_prsok", R::zero, "the slave's count has been preset", "000 1.9.6"},
    State{"st_prsonm", R::zero, "the master's preset search runs", "000 1.9.6"},
    State{"st_prsokm", R::zero, "the master's count has been preset", "000 1.9.6"},
    State{"st_still", R::one, "no positioning movement runs; stays 1 in a cam", "000 1.9.6"},
    State{"st_camex", R::zero, "a cam runs", "000 1.9.6"},
    State{"st_movdir", R::zero, "direction of the last positioning movement, 1 = backward", "000 1.9.6"},
    State{"st_loopon", R::zero, "the position loop is closed", "000 1.9.6"},
    State{"st_foller", R::zero, "following error above maxfollerr, held for 500 ms", "000 1.9.6"},
    State{"st_sync", R::zero, "in a cam and the following error is within syncrange", "000 1.9.6"},
    State{"st_cal", R::zero, "calibration: the output is the voltage vout", "000 1.9.6"},
    State{"st_cntlock", R::retentive, "the slave's count is locked", "000 1.9.6"},
    State{"st_cntrev", R::retentive, "the slave's count is reversed", "000 1.9.6"},
    State{"st_cntlockm", R::retentive, "the master's count is locked", "000 1.9.6"},
    State{"st_cntrevm", R::retentive, "the master's count is reversed", "000 1.9.6"},
    State{"st_regoff", R::zero, "regulation off: the DAC keeps its word, movements are refused", "000 1.9.6"},
    State{"st_enbl", R::zero, "the function of the normal input is armed", "000 1.9.6"},
    State{"st_intenbl", R::zero, "the function of the interrupt input is armed", "000 1.9.6"},
    State{"st_capt", R::zero, "the function of the normal input has run", "000 1.9.6"},
    State{"st_intcapt", R::zero, "the function of the interrupt input has run", "000 1.9.6"},
    State{"st_int", R::zero, "level of the interrupt line InGInt", "000 1.9.6"},
    State{"st_error", R::zero, "an error stopped the axis; errcode and errvalue say which", "000 1.9.6"},
    State{"st_warning", R::zero, "a warning stands; wrncode and wrnvalue say which", "000 1.9.6"},
    State{"st_acc", R::zero, "a positioning movement accelerates", "000 1.9.6"},
    State{"st_dec", R::zero, "a positioning movement decelerates", "000 1.9.6"},
    State{"st_vconst", R::zero, "a positioning movement runs at constant speed", "000 1.9.6"},
};

/// The condition that these states are 1, or 0 where the name begins with '!'.
consteval Condition needs(std::initializer_list<std::string_view> names, std::string_view also = {}) {
  Condition condition{0, 0, also};
  for (std::string_view name : names) {
    const bool off = name.starts_with('!');
    const std::uint64_t bit = std::uint64_t{1} << row_of(states, off ? name.substr(1) : name);
    condition.mask |= bit;
    if (!off) condition.value |= bit;
  }
  return condition;
}

inline constexpr Condition any = {};
/// Resolution and speed scale may change while nothing moves.
inline constexpr Condition at_rest = needs({"st_still", "!st_camex", "!st_prson"});

inline constexpr std::array commands = {
    Command{"INIT", needs({"!st_init"}), "computes the parameters and starts the device", "000 1.9.5"},
    Command{"EMRG", needs({"st_init"}), "stops everything without ramp, opens the reaction, output 0 V",
            "000 1.9.5"},
    Command{"RESUME", needs({"st_init", "st_emrg"}), "ends the emergency; the axis reacts where it stands",
            "000 1.9.5"},
    Command{"STOP", needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "!st_still", "!st_camex"}),
            "ends a positioning movement with the ramp tdec", "000 1.9.5"},
    Command{"START",
            needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "st_still", "!st_camex", "!st_prson"}),
            "places the slave at setpos with setvel", "000 1.9.5"},
    Command{
        "PRESET",
        needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "!st_camex"}, "st_still = 1 or st_prson = 1"),
        "starts the slave's preset search; while it runs, turns its direction", "000 1.9.5"},
    Command{"RSPRSOK", needs({"st_init", "!st_prson"}), "clears st_prsok", "000 1.9.5"},
    Command{"PRESETM", needs({"st_init", "!st_camex", "!st_prsonm"}), "starts the master's preset search",
            "000 1.9.5"},
    Command{"RSPRSM", needs({"st_init"}), "clears st_prsokm, or ends the master's preset search",
            "000 1.9.5"},
    Command{"RSERR", needs({"st_init"}), "clears st_error, errcode, errvalue; the emergency stays",
            "000 1.9.5"},
    Command{"RSWRN", needs({"st_init"}), "clears st_warning, wrncode, wrnvalue", "000 1.9.5"},
    Command{"LOOPON", needs({"st_init", "!st_loopon"}),
            "closes the position loop; the following error becomes 0", "000 1.9.5"},
    Command{"LOOPOFF", needs({"st_init", "st_loopon"}), "opens the position loop without stopping the axis",
            "000 1.9.5"},
    Command{"MANFW",
            needs({"st_init", "!st_regoff", "!st_prson", "!st_camex", "!st_cal", "st_still", "!st_emrg"}),
            "runs forward at setvel until STOP, at most to maxpos", "000 1.9.5"},
    Command{"MANBW",
            needs({"st_init", "!st_regoff", "!st_prson", "!st_camex", "!st_cal", "st_still", "!st_emrg"}),
            "runs backward at setvel until STOP, at most to minpos", "000 1.9.5"},
    Command{"CALON", needs({"st_init"}), "makes the output a voltage source set by vout; ends any movement",
            "000 1.9.5"},
    Command{"CALOFF", needs({"st_init", "st_cal"}), "ends calibration; the axis reacts where it stands",
            "000 1.9.5"},
    Command{"CNTLOCK", needs({"st_init"}), "stops counting the slave's transducer", "000 1.9.5"},
    Command{"CNTUNLOCK", needs({"st_init"}), "counts the slave's transducer again", "000 1.9.5"},
    Command{"CNTREV", needs({"st_init"}), "reverses the slave's counting direction", "000 1.9.5"},
    Command{"CNTDIR", needs({"st_init"}), "restores the slave's counting direction", "000 1.9.5"},
    Command{"CNTLOCKM", needs({"st_init"}), "stops counting the master's transducer", "000 1.9.5"},
    Command{"CNTUNLOCKM", needs({"st_init"}), "counts the master's transducer again", "000 1.9.5"},
    Command{"CNTREVM", needs({"st_init"}), "reverses the master's counting direction", "000 1.9.5"},
    Command{"CNTDIRM", needs({"st_init"}), "restores the master's counting direction", "000 1.9.5"},
    Command{"STOPCAM", needs({"st_init", "st_camex"}, "25 ms since a start by input function 11 or 12"),
            "leaves the master at once and stops with the ramp tdec", "000 1.9.5"},
    Command{"STARTCAM",
            needs({"st_init", "st_still", "!st_camex", "!st_prson", "!st_emrg", "!st_regoff", "!st_error",
                   "!st_cal"}),
            "starts the cam at row 1, origin where master and slave are", "000 1.9.5"},
    Command{"REGOFF", needs({"st_init", "st_still", "!st_camex", "!st_prson"}),
            "turns regulation off: the DAC keeps its word", "000 1.9.5"},
    Command{"REGON", needs({"st_init", "st_still", "st_regoff", "!st_emrg"}),
            "turns regulation on; the axis reacts where it stands", "000 1.9.5"},
    Command{"ENBL", needs({"st_init"}, "inpcapt > 0"), "arms the function of the normal input", "000 1.9.5"},
    Command{"INTENBL", needs({"st_init"}, "intcapt > 0"), "arms the function of the interrupt input",
            "000 1.9.5"},
    Command{"DSBL", needs({"st_init"}), "disarms the function of the normal input", "000 1.9.5"},
    Command{"INTDSBL", needs({"st_init"}), "disarms the function of the interrupt input", "000 1.9.5"},
    Command{"RSCAPT", needs({"st_init", "st_capt"}), "clears st_capt", "000 1.9.5"},
    Command{"RSINTCAPT", needs({"st_init", "st_intcapt"}), "clears st_intcapt", "000 1.9.5"},
    Command{"DELCNT", needs({"st_init", "st_still", "!st_camex", "!st_prson", "!st_cal", "!st_regoff"}),
            "adds delta1 [Um] to posit, remainder kept", "000 1.9.5"},
    Command{"DELCNTM", needs({"st_init", "!st_prsonm", "!st_camex"}),
            "adds delta2 [Um] to positm, remainder kept", "000 1.9.5"},
};

inline constexpr double lowest = -2147483648.0;
inline constexpr double highest = 2147483647.0;

inline constexpr std::array variables = {
    Variable{"decpt", Size::B, "", 0, 3, read_write, R::retentive, at_rest,
             "decimals of the slave's unit of measure: speeds are in whole units", "000 1.9.2"},
    Variable{"measure", Size::L, "Um", 1, 999999, read_write, R::retentive, at_rest,
             "slave space in which its transducer gives `pulse` bits", "000 1.9.2"},
    Variable{"pulse", Size::L, "bits x4", 1, 999999, read_write, R::retentive, at_rest,
             "slave transducer bits in the space `measure`", "000 1.9.2"},
    Variable{"measurem", Size::L, "Um", 1, 999999, read_write, R::retentive, at_rest,
             "master space in which its transducer gives `pulsem` bits", "000 1.9.2"},
    Variable{"pulsem", Size::L, "bits x4", 1, 999999, read_write, R::retentive, at_rest,
             "master transducer bits in the space `measurem`", "000 1.9.2"},
    Variable{"unitvel", Size::B, "", 0, 1, read_write, R::retentive, at_rest,
             "time unit of speeds: 0 per minute, 1 per second", "000 1.9.2"},
    Variable{"maxvel", Size::L, "speed", 0, 999999, read_write, R::retentive, at_rest,
             "slave speed at an output of 10 V", "000 1.9.2"},
    Variable{"prsvel", Size::L, "speed", 0, 999999, read_write, R::retentive, needs({"!st_prson"}),
             "speed of the preset search toward the enable input, up to maxvel", "000 1.9.2"},
    Variable{"sprsvel", Size::L, "speed", 0, 999999, read_write, R::retentive, needs({"!st_prson"}),
             "speed of the preset search's slow leg, up to prsvel", "000 1.9.2"},
    Variable{"taccmax", Size::W, "1/100 s", 0, 999, read_write, R::retentive, needs({"!st_prson"}),
             "shortest time from rest to maxvel in a cam, else warning 1; 0 = not watched", "000 1.9.2"},
    Variable{"tdecmax", Size::W, "1/100 s", 0, 999, read_write, R::retentive, needs({"!st_prson"}),
             "shortest time from maxvel to rest in a cam, else warning 2; 0 = not watched", "000 1.9.2"},
    Variable{"tacc", Size::W, "1/100 s", 0, 999, read_write, R::retentive, any,
             "acceleration time from rest to maxvel", "000 1.9.2"},
    Variable{"tdec", Size::W, "1/100 s", 0, 999, read_write, R::retentive, any,
             "deceleration time from maxvel to rest", "000 1.9.2"},
    Variable{"maxpos", Size::L, "Um", -999999, 999999, read_write, R::retentive, needs({"st_still"}),
             "largest quota of placements and manual movements", "000 1.9.2"},
    Variable{"minpos", Size::L, "Um", -999999, 999999, read_write, R::retentive, needs({"st_still"}),
             "smallest quota of placements and manual movements", "000 1.9.2"},
    Variable{"prspos", Size::L, "Um", -999999, 999999, read_write, R::retentive, needs({"st_still"}),
             "quota that the slave's preset search loads, minpos..maxpos", "000 1.9.2"},
    Variable{"prsposm", Size::L, "Um", -999999, 999999, read_write, R::retentive, needs({"!st_prsonm"}),
             "quota that the master's preset search loads", "000 1.9.2"},
    Variable{"toll", Size::L, "Um", 0, 999999, read_write, R::retentive, needs({"st_still"}),
             "largest distance from the quota for st_toll and st_tpos", "000 1.9.2"},
    Variable{"maxfollerr", Size::L, "bits x4", 0, highest, read_write, R::retentive, any,
             "following error above which st_foller is reported", "000 1.9.2"},
    Variable{"syncrange", Size::L, "Um", 0, 999999, read_write, R::retentive, any,
             "following error up to which st_sync is reported in a cam", "000 1.9.2"},
    Variable{"prsmode", Size::B, "", 0, 2, read_write, R::retentive, needs({"!st_prson"}),
             "slave preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable without "
             "search",
             "000 1.9.2"},
    Variable{"prsmodem", Size::B, "", 0, 2, read_write, R::retentive, needs({"!st_prsonm"}),
             "master preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable "
             "without search",
             "000 1.9.2"},
    Variable{"prsdir", Size::B, "", 0, 1, read_write, R::retentive, needs({"!st_prson"}),
             "first direction of the slave's preset search: 0 forward, 1 backward", "000 1.9.2"},
    Variable{"mtype", Size::B, "", 0, 1, read_write, R::retentive, any,
             "master in use: 0 CountMA, 1 CountMB; may change in a cam, positm does not jump", "000 1.9.2"},
    Variable{"ramptype", Size::B, "", 0, 1, read_write, R::retentive, needs({"st_still"}),
             "ramps of positioning: 0 trapezoidal, 1 epicycloidal", "000 1.9.2"},
    Variable{"rtype", Size::B, "", 0, 1, read_write, R::retentive, any,
             "short epicycloidal movements: 0 keep ramp times, 1 keep gradients", "000 1.9.2"},
    Variable{"stopt", Size::B, "", 0, 1, read_write, R::retentive, any,
             "STOP in an epicycloidal acceleration: 0 ends the ramp first, 1 decelerates at once",
             "000 1.9.2"},
    Variable{"pgain", Size::W, "1/1000", 0, 32767, read_write, R::retentive, any,
             "proportional gain: 1000 gives 10 V at the way of maxvel in one TCamp", "000 1.9.2"},
    Variable{"feedfw", Size::W, "1/1000", 0, 32767, read_write, R::retentive, any,
             "feed-forward: 1000 gives 10 V at the theoretical speed maxvel", "000 1.9.2"},
    Variable{"integt", Size::W, "ms", 0, 32767, read_write, R::retentive, any,
             "integration time, smaller is stronger, 0 = off", "000 1.9.2"},
    Variable{"derivt", Size::W, "ms", 0, 32767, read_write, R::retentive, any,
             "derivative time, larger is stronger, 0 = off", "000 1.9.2"},
    Variable{"offset", Size::W, "DAC bits", -32767, 32767, read_write, R::retentive, any,
             "added to the output always while the device drives it", "000 1.9.2"},
    Variable{"tbfm", Size::W, "", 0, 3, read_write, R::retentive, any,
             "window of frqm: 0 240 ms, 1 480 ms, 2 24 ms, 3 120 ms", "000 1.9.2"},
    Variable{"tbf", Size::W, "", 0, 3, read_write, R::retentive, any,
             "window of frq and vel: 0 240 ms, 1 480 ms, 2 24 ms, 3 120 ms", "000 1.9.2"},
    Variable{"frqm", Size::L, "Hz", lowest, highest, read, R::zero, any,
             "frequency of one phase of the master's transducer", "000 1.9.3"},
    Variable{"positm", Size::L, "Um", -999999, 999999, read_write, R::retentive,
             needs({"st_init", "!st_camex"}), "master's position", "000 1.9.3"},
    Variable{"encoderm", Size::L, "bits x4", lowest, highest, read_write, R::retentive,
             needs({"st_init", "!st_camex"}), "master's position", "000 1.9.3"},
    Variable{"vout", Size::B, "0.1 V", -100, 100, read_write, R::zero, needs({"st_init", "st_cal"}),
             "output voltage: set in calibration, shown otherwise", "000 1.9.3"},
    Variable{"follerr", Size::L, "bits x4", lowest, highest, read, R::zero, any,
             "magnitude of theoretical minus actual position", "000 1.9.3"},
    Variable{"vel", Size::L, "speed", lowest, highest, read, R::zero, any,
             "magnitude of the slave's speed, from frq's window", "000 1.9.3"},
    Variable{"frq", Size::L, "Hz", lowest, highest, read, R::zero, any,
             "frequency of one phase of the slave's transducer", "000 1.9.3"},
    Variable{"posit", Size::L, "Um", -999999, 999999, read_write, R::retentive,
             needs({"st_init", "!st_camex"}), "slave's position", "000 1.9.3"},
    Variable{"encoder", Size::L, "bits x4", lowest, highest, read_write, R::retentive,
             needs({"st_init", "!st_camex"}), "slave's position", "000 1.9.3"},
    Variable{"delta1", Size::L, "", lowest, highest, read_write, R::retentive, any,
             "what DELCNT adds; register of the input functions", "000 1.9.3"},
    Variable{"delta2", Size::L, "", lowest, highest, read_write, R::retentive, any,
             "what DELCNTM adds; register of the input functions", "000 1.9.3"},
    Variable{"setvel", Size::L, "speed", 0, 999999, read_write, R::retentive, any,
             "speed of placements and manual movements, up to maxvel", "000 1.9.3"},
    Variable{"setpos", Size::L, "Um", -999999, 999999, read_write, R::retentive, any,
             "quota of placements, minpos..maxpos", "000 1.9.3"},
    Variable{"rowex", Size::W, "", 0, 128, read, R::zero, any, "running row of the cam table, 0 = no cam",
             "000 1.9.3"},
    Variable{"ffwdreg", Size::L, "DAC bits", lowest, highest, read, R::zero, any, "feed-forward action",
             "000 1.9.3"},
    Variable{"propreg", Size::L, "DAC bits", lowest, highest, read, R::zero, any, "proportional action",
             "000 1.9.3"},
    Variable{"intreg", Size::L, "DAC bits", lowest, highest, read, R::zero, any, "integral action",
             "000 1.9.3"},
    Variable{"derreg", Size::L, "DAC bits", lowest, highest, read, R::zero, any, "derivative action",
             "000 1.9.3"},
    Variable{"codeMex", Size::L, "", lowest, highest, read, R::zero, any,
             "codeM of the running movement row, 0 without a cam", "000 1.9.3"},
    Variable{"funInp", Size::B, "", 0, 99, read_write, R::retentive, any, "function of the normal input InG",
             "000 1.7"},
    Variable{"funInt", Size::B, "", 0, 99, read_write, R::retentive, any,
             "function of the interrupt input InGInt", "000 1.7"},
    Variable{"funOut", Size::B, "", 0, 99, read_write, R::retentive, any, "function of the output Out",
             "000 1.8"},
    Variable{"inpcapt", Size::B, "", 0, 2, read_write, R::zero, any,
             "edge of the normal input that runs funInp: 0 none, 1 falling, 2 rising", "000 1.9.3"},
    Variable{"intcapt", Size::B, "", 0, 2, read_write, R::zero, any,
             "edge of the interrupt input that runs funInt: 0 none, 1 falling, 2 rising", "000 1.9.3"},
    Variable{"errcode", Size::B, "", 0, 100, read, R::zero, any, "error that stopped the axis", "000 1.3"},
    Variable{"errvalue", Size::B, "", 0, 128, read, R::zero, any, "row that caused the error", "000 1.3"},
    Variable{"wrncode", Size::B, "", 0, 100, read, R::zero, any, "standing warning of the highest priority",
             "000 1.4"},
    Variable{"wrnvalue", Size::B, "", 0, 128, read, R::zero, any, "row that caused the warning", "000 1.4"},
    Variable{"codeG", Size::W, "", -128, 254, read_write, R::retentive, needs({}, "rowex != n"),
             "operating instruction of the row; -128..-1 act as 128..255", "000 1.9.4", 128},
    Variable{"codeQm", Size::L, "Um", -159154, 999999, read_write, R::retentive, needs({}, "rowex != n"),
             "master's part of the row: space, ratio, radius, row or count, as codeG says", "000 1.9.4", 128},
    Variable{"codeQs", Size::L, "Um", -999999, 999999, read_write, R::retentive,
             needs({}, "rowex != n, or gearing"),
             "slave's part of the row: space, ratio, displacement or count, as codeG says", "000 1.9.4", 128},
    Variable{"codeQma", Size::L, "Um", 0, 999999, read_write, R::retentive, needs({}, "rowex != n"),
             "master's auxiliary part of the row; read-out of 170..175 and 190", "000 1.9.4", 128},
    Variable{"codeQsa", Size::L, "bits x4", -999999, 999999, read_write, R::retentive,
             needs({}, "rowex != n, or gearing"), "slave's auxiliary part of the row", "000 1.9.4", 128},
    Variable{"codeM", Size::L, "", lowest, highest, read_write, R::retentive, needs({}, "rowex != n"),
             "number for the program, shown in codeMex while the row runs", "000 1.9.4", 128},
};

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

}  // namespace table
}  // namespace drycut::devices::camming4
