#pragma once
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "devices/device.hpp"

// The public face of EPICPOS (002 1.4; spec qem.md 6, with the print's slips corrected as D1 and D16 say).
// EANPOS has the same rows but for the last ones (spec qem.md 7, D17).

namespace drycut::devices::epicpos::table {

using R = Retention;
using devices::joined;

inline constexpr std::array states_rows = {
    State{"st_init", R::zero, "the device is initialised and runs"},
    State{"st_emrg", R::zero, "emergency: no reaction, no movement, output 0 V"},
    State{"st_toll", R::zero, "the last placement stands within toll of its quota, for toldly already"},
    State{"st_prsok", R::zero, "the count has been preset"},
    State{"st_still", R::one, "no movement runs"},
    State{"st_prson", R::zero, "the preset search runs"},
    State{"st_movdir", R::zero, "direction of the last movement, 1 = backward"},
    State{"st_loopon", R::zero, "the position loop is closed"},
    State{"st_foller", R::zero, "following error above maxfollerr, held for 500 ms"},
    State{"st_regoff", R::zero, "regulation off: the DAC is left as it stands, movements are refused"},
    State{"st_cal", R::zero, "calibration: the output is the voltage vout"},
    State{"st_cntlock", R::retentive, "the count is locked"},
    State{"st_cntrev", R::retentive, "the count is reversed"},
};
inline constexpr auto states = in_section("002 1.4.4", states_rows);

inline constexpr Needs<states> needs;
inline constexpr Turns<states, false> turns;
inline constexpr Turns<states, true> turns_quietly;  ///< where it holds already: a silent no-op

inline constexpr Condition initialised = needs({"st_init"});
inline constexpr Condition still = needs({"st_still"});
inline constexpr Condition can_move = needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "st_still"});

inline constexpr std::array commands_rows = {
    command("INIT", needs({"!st_init"}), "computes the parameters and starts the device"),
    command("EMRG", initialised, "stops everything without ramp, opens the reaction, output 0 V",
            turns("st_emrg")),
    command("RESUME", needs({"st_init", "st_emrg"}), "ends the emergency; the axis reacts where it stands",
            turns_quietly("!st_emrg")),
    command("START", can_move, "places the axis at setpos with setvel"),
    command("STOP", needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal", "!st_still"}),
            "ends a movement with the deceleration ramp"),
    command("LOOPON", initialised, "closes the position loop; the following error becomes 0",
            turns("st_loopon")),
    command("LOOPOFF", initialised, "opens the position loop without stopping the axis", turns("!st_loopon")),
    command("CNTLOCK", initialised, "stops counting the transducer; no preset is loaded",
            turns("st_cntlock")),
    command("CNTUNLOCK", initialised, "counts the transducer again", turns("!st_cntlock")),
    command("CNTREV", initialised, "reverses the counting direction", turns("st_cntrev")),
    command("CNTDIR", initialised, "restores the counting direction", turns("!st_cntrev")),
    command("PRESET", needs({"st_init", "!st_regoff", "!st_emrg", "!st_cal"}, "st_still = 1 or st_prson = 1"),
            "starts the preset search; while it runs, turns its direction"),
    command("CALON", initialised, "makes the output a voltage source set by vout; ends any movement",
            turns_quietly("st_cal")),
    command("CALOFF", needs({"st_init", "st_cal"}), "ends calibration; the axis reacts where it stands",
            turns_quietly("!st_cal")),
    command("MANFW", needs({"st_init", "!st_regoff", "!st_prson", "st_still", "!st_emrg", "!st_cal"}),
            "runs forward at setvel until STOP, at most to maxpos"),
    command("MANBW", needs({"st_init", "!st_regoff", "!st_prson", "st_still", "!st_emrg", "!st_cal"}),
            "runs backward at setvel until STOP, at most to minpos"),
    command("REGOFF", needs({"st_init", "st_still"}),
            "turns regulation off: the DAC stays as it stands, free for another device",
            turns_quietly("st_regoff")),
    command("REGON", needs({"st_init", "st_regoff"}), "turns regulation on; the axis reacts where it stands",
            turns_quietly("!st_regoff")),
    command("DELCNT", needs({"st_init", "st_still"}), "adds delta to posit, remainder kept"),
};
inline constexpr auto commands = in_section("002 1.4.2", commands_rows);

/// A ramp parameter written in mid-move is stored; the running movement takes it if it can.
inline constexpr Condition ramp_write = needs({}, "the quota to stay in reach, to act in motion");

inline constexpr std::array variables_rows = {
    kept("cntratio", Size::L, "Um/pulse x 1e5", 374, 400000, still,
         "resolution: 100000 times the Um of one transducer pulse (4 bits)"),
    kept("maxpos", Size::L, "Um", -999999, 999999, still, "largest quota of placements and manual movements"),
    kept("minpos", Size::L, "Um", -999999, 999999, still,
         "smallest quota of placements and manual movements"),
    kept("prspos", Size::L, "Um", -999999, 999999, still,
         "quota that the preset search loads, minpos..maxpos"),
    kept("maxvel", Size::L, "speed", 0, 999999, still, "speed at an output of 10 V"),
    kept("prsvel", Size::L, "speed", 0, 999999, still,
         "speed of the preset search toward the enable input, up to maxvel"),
    kept("sprsvel", Size::L, "speed", 0, 999999, still,
         "speed of the preset search's slow leg, up to prsvel"),
    kept("toll", Size::L, "Um", 0, 999999, still, "largest distance from the quota for st_toll"),
    kept("maxfollerr", Size::L, "bits x4", 0, highest, "following error above which st_foller is reported"),
    kept("rampmode", Size::B, "", 0, 1, ramp_write,
         "0: taccdec is the time of both ramps, 1: tacc and tdec are"),
    kept("taccdec", Size::W, "1/100 s", 0, 999, ramp_write,
         "time from rest to maxvel and from maxvel to rest, if rampmode is 0"),
    kept("tacc", Size::W, "1/100 s", 0, 999, ramp_write,
         "acceleration time from rest to maxvel, if rampmode is 1"),
    kept("tdec", Size::W, "1/100 s", 0, 999, ramp_write,
         "deceleration time from maxvel to rest, if rampmode is 1"),
    kept("tinvt", Size::W, "1/100 s", 0, 999,
         "shortest rest between a movement and one in the other direction"),
    kept("toldly", Size::W, "1/100 s", 0, 999, "time in tolerance after a placement before st_toll says so"),
    kept("pgain", Size::W, "1/1000", 0, 32767,
         "proportional gain: 1000 gives 10 V at the way of maxvel in one TCamp"),
    kept("feedfw", Size::W, "1/1000", 0, 32767,
         "feed-forward: 1000 gives 10 V at the theoretical speed maxvel"),
    kept("integt", Size::W, "ms", 0, 32767, "integration time, smaller is stronger, 0 = off"),
    kept("derivt", Size::W, "ms", 0, 32767, "derivative time, larger is stronger, 0 = off"),
    kept("prsmode", Size::B, "", 0, 2,
         "preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable without search"),
    kept("prsdir", Size::B, "", 0, 1, "first direction of the preset search: 0 forward, 1 backward"),
    kept("unitvel", Size::B, "", 0, 1, still, "time unit of speeds: 0 per minute, 1 per second"),
    kept("decpt", Size::B, "", 0, 3, still, "decimals of the unit of measure: speeds are in whole units"),
    kept("offset", Size::W, "DAC bits", -32768, 32767,
         "added to the output always while the device drives it"),
    kept("setpos", Size::L, "Um", -999999, 999999,
         needs({}, "a quota that the running placement can still reach without turning"),
         "quota of placements, minpos..maxpos; the preset search alters it"),
    kept("setvel", Size::L, "speed", 0, 999999,
         needs({}, "no deceleration to the quota yet, to act in motion"),
         "speed of placements and manual movements, up to maxvel; the preset search alters it"),
    zeroed("vout", Size::B, "0.1 V", -100, 100, needs({"st_cal"}), "output voltage of the calibration"),
    shown("vel", "speed", "magnitude of the axis' speed, from frq's window"),
    shown("frq", "Hz", "frequency of one phase of the transducer over 240 ms"),
    kept("posit", Size::L, "Um", -999999, 999999,
         needs({}, "no deceleration to the quota yet, and the quota ahead, in motion"),
         "position of the axis"),
    shown("follerr", "bits x4", "theoretical minus actual position"),
    shown("ffwdreg", "DAC bits", "feed-forward action"),
    shown("propreg", "DAC bits", "proportional action"),
    shown("integ", Size::L, "DAC bits", -1024, 1024, "integral action"),
    shown("derreg", Size::L, "DAC bits", -1024, 1024, "derivative action"),
    kept("delta", Size::L, "Um", -999999, 999999, "what DELCNT adds"),
};
inline constexpr auto variables = in_section("002 1.4.3", variables_rows);

/// What only EPICPOS has.
inline constexpr std::array epicpos_variables_rows = {
    kept("rtype", Size::B, "", 0, 1, "short movements: 0 keep ramp times, 1 keep gradients"),
    kept("stopt", Size::B, "", 0, 1, "STOP in an acceleration: 0 ends the ramp first, 1 decelerates at once"),
};
inline constexpr auto epicpos_variables = in_section("002 1.4.3", epicpos_variables_rows);

/// What only EANPOS has.
inline constexpr std::array eanpos_variables_rows = {
    kept("ramptype", Size::B, "", 0, 1, still, "ramps: 0 trapezoidal, 1 epicycloidal"),
};
inline constexpr auto eanpos_variables = in_section("000 1.5", eanpos_variables_rows);

inline constexpr std::array fields = {
    Field{"TCamp", Field::Kind::period_ms, 1, 255, "sampling time [ms]"},
    Field{"ICont", Field::Kind::counter, 0, 0,
          "transducer; on slot 1 a simulated one that the device itself moves"},
    Field{"IntL", Field::Kind::interrupt_line, 1, 8, "zero pulse"},
    Field{"IAZero", Field::Kind::input, 0, 0, "enable of the preset"},
    Field{"IOutA", Field::Kind::analogue, 0, 0, "speed reference"},
};

/// Spellings of the manual's text and programs beside those of its table (spec 6).
inline constexpr std::array aliases = {
    Alias{"cnratio", "cntratio"}, Alias{"prsvl", "prsvel"},       Alias{"prsvcl", "prsvel"},
    Alias{"sprsvl", "sprsvel"},   Alias{"sprsvcl", "sprsvel"},    Alias{"spsvl", "sprsvel"},
    Alias{"prmdir", "prsdir"},    Alias{"prsdire", "prsdir"},     Alias{"folterr", "follerr"},
    Alias{"intreg", "integ"},     Alias{"feedforward", "feedfw"}, Alias{"rampm", "rampmode"},
    Alias{"tolldly", "toldly"},
};

/// Where the manual of EPICPOS leaves something open, and what EPICPOS and EANPOS do there (spec qem.md 10).
inline constexpr std::array readings = {
    ManualReading{"",
                  "commands wait for the next sample, which takes them as a set in the order of the table",
                  "002 1.4.2 gives priorities and 1.3.4.2 an overlap of two DELCNT, no mechanism"},
    ManualReading{"cntratio", "from 374, which is 0.00374 Um a pulse",
                  "002 1.4.3 prints 347, 1.2.1 means 0.00374"},
    ManualReading{"toll", "from 0", "002 1.4.3 prints a range from -999999 for a distance"},
    ManualReading{"offset", "-32768..32767", "002 1.4.3: the range is cut off in print"},
    ManualReading{"integt",
                  "the integral action grows by the proportional action of pgain 1000 in each integt",
                  "002 1.2.4.3 gives the direction of the effect, no scale"},
    ManualReading{
        "derivt",
        "the derivative action is the error's change in derivt, scaled as pgain 1000 scales the error",
        "002 1.2.4.4 gives the direction of the effect, no scale"},
    ManualReading{"integ", "the integral action is limited to +-1024 bits",
                  "002 1.4.3 prints the range 0..1024 only"},
    ManualReading{"derreg", "the derivative action is limited to +-1024 bits",
                  "002 1.4.3 prints the range 0..1024 only"},
    ManualReading{"setvel", "a value that comes in a ramp waits for its end",
                  "002 1.5 allows a change at constant speed only, 1.3.3 before the final deceleration"},
    ManualReading{"setpos", "a START beyond minpos..maxpos goes to the limit, and says so",
                  "002 1.4.3 gives the range, no answer to a quota outside"},
    ManualReading{"EMRG", "leaves the output alone while st_regoff = 1",
                  "002 1.3.1 gives no access to the DAC then, 1.4.2 puts the axis in emergency all the same"},
    ManualReading{"follerr",
                  "the loop's error has fractions of a bit; st_foller goes by the whole bits of follerr",
                  "002 1.4.3 gives follerr in bits, and nothing says what the loop works on"},
    ManualReading{"START", "needs st_cal = 0 where the print repeats st_emrg = 0",
                  "002 1.4.2 prints st_emrg twice"},
    ManualReading{"PRESET", "with the enable already on, the search begins with its slow leg, reversed",
                  "002 1.2.5.2 begins with the enable off"},
    ManualReading{"MANFW", "needs st_emrg = 0 and st_cal = 0 too", "002 1.4.2 does not name them"},
    ManualReading{"MANBW", "needs st_emrg = 0 and st_cal = 0 too", "002 1.4.2 does not name them"},
    ManualReading{"REGOFF", "turns regulation off",
                  "002 1.4.2: the titles of REGOFF and REGON are exchanged in print"},
    ManualReading{
        "",
        "of two devices that regulate on one output, the later one of INTDEVICE has the last word; a note "
        "tells it once",
        "002 1.3.1 forbids it and does not say what happens then"},
    ManualReading{"st_toll", "goes by the quota of the last START until a manual movement or a search",
                  "002 1.4.4 names that quota and not what ends it"},
    ManualReading{"REGON", "turns regulation on",
                  "002 1.4.2: the titles of REGOFF and REGON are exchanged in print"},
};

inline constexpr auto all_variables = joined(variables, epicpos_variables);

}  // namespace drycut::devices::epicpos::table

namespace drycut::devices::epicpos {

/// EPICPOS: analogue positioner with epicycloidal ramps (002; spec qem.md 6).
inline constexpr DeviceType epicpos_type = {
    "EPICPOS",
    "analogue positioner with epicycloidal ramps",
    table::all_variables,
    table::states,
    table::commands,
    table::fields,
    table::aliases,
    table::readings,
};

}  // namespace drycut::devices::epicpos
