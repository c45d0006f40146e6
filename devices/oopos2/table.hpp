#pragma once
#include <array>
#include <string_view>

#include "devices/device.hpp"

// The public face of OOPOS2 (001 1.6; spec qem.md 9, with the print's slips corrected as D1 and D34 say).
namespace drycut::devices::oopos2::table {

using R = Retention;
using enum Access;

inline constexpr std::array states_rows = {
    State{"st_init", R::zero, "the device is initialised and runs"},
    State{"st_cntlock", R::retentive, "the count is locked"},
    State{"st_cntrev", R::retentive, "the count is reversed"},
    State{"st_movfwd", R::zero, "the forward output is on"},
    State{"st_movbwd", R::zero, "the backward output is on"},
    State{"st_movslow", R::zero, "the slowdown output is on"},
    State{"st_toll", R::zero, "the last placement ended in tolerance, or a START found the axis there"},
    State{"st_brake", R::zero, "level of the brake output: what brakes is breaktype's"},
    State{"st_movdir", R::zero, "direction of the last movement, 1 = backward"},
    State{"st_still", R::one, "no movement runs"},
    State{"st_erin", R::zero, "the last recalculation changed the inertia by more than maxiner"},
    State{"st_sttoll", R::zero,
          "the last of START and the manual movements was a START in tolerance, and nothing moved"},
    State{"st_prsok", R::zero, "the count has been preset"},
    State{"st_prson", R::zero, "the preset search runs"},
    State{"st_regoff", R::zero, "regulation off: the movement outputs are left to others, no movement"},
};
inline constexpr auto states = in_section("001 1.6.4", states_rows);

inline constexpr Needs<states> needs;
inline constexpr Turns<states, false> turns;

inline constexpr Condition initialised = needs({"st_init"});
inline constexpr Condition below = needs({"st_init", "!st_regoff"}, "posit < maxpos");
inline constexpr Condition above = needs({"st_init", "!st_regoff"}, "posit > minpos");

inline constexpr std::array commands_rows = {
    command("INIT", needs({"!st_init"}), "computes the parameters and starts the device"),
    command("STOP", needs({"st_init", "!st_regoff"}),
            "switches the movement outputs off; the axis is still after toldly"),
    command("START", needs({"st_init", "!st_regoff", "st_still"}), "places the axis at setpos plus tool"),
    command("CNTLOCK", initialised, "stops counting the transducer; no preset is loaded",
            turns("st_cntlock")),
    command("CNTUNLOCK", initialised, "counts the transducer again", turns("!st_cntlock")),
    command("CNTREV", initialised, "reverses the counting direction", turns("st_cntrev")),
    elsewhere("001 1.8.2",
              command("CNTDIR", initialised, "restores the counting direction", turns("!st_cntrev"))),
    command("PRESET", needs({"st_init", "!st_regoff"}),
            "starts the preset search; while it runs, turns its direction"),
    command("MANSFW", below, "runs forward slowly until STOP, at most to maxpos"),
    command("MANSBW", above, "runs backward slowly until STOP, at most to minpos"),
    command("MANFFW", below, "runs forward until STOP, at most to maxpos"),
    command("MANFBW", above, "runs backward until STOP, at most to minpos"),
    command("REGON", initialised, "takes the movement outputs", turns("!st_regoff")),
    command("REGOFF", initialised, "ends any movement and leaves the movement outputs to other devices",
            turns("st_regoff")),
    command("DELCNT", needs({"st_init", "st_still"}), "adds delta to posit, remainder kept"),
};
inline constexpr auto commands = in_section("001 1.6.2", commands_rows);

/// iner01 to iner16: a row each, as the manual names them.
consteval DeviceVariable inertia(std::string_view name, std::string_view meaning) {
  return elsewhere("001 1.4.6", kept(name, Size::W, "Um/10", 0, 32767, meaning));
}

inline constexpr std::array variables_rows = {
    kept("cntratio", Size::L, "Um/pulse x 1e5", 374, 400000,
         "resolution: 100000 times the Um of one transducer pulse (4 bits)"),
    kept("posit", Size::L, "Um", -999999, 999999,
         needs({"st_init"}, "the quota ahead and not in the slow range, while a placement runs"),
         "position of the axis"),
    kept("minpos", Size::L, "Um", -999999, 999999, "smallest quota of placements and manual movements"),
    kept("maxpos", Size::L, "Um", -999999, 999999, "largest quota of placements and manual movements"),
    kept("slowpos", Size::W, "Um", 0, 9999,
         "slow range: way before the quota in which the slowdown output is on, if slowtype is 0"),
    kept("tollp", Size::W, "Um/10", 0, 9999, "largest excess over the quota in tolerance"),
    kept("tolln", Size::W, "Um/10", 0, 9999, "largest shortage of the quota in tolerance"),
    kept("tinvt", Size::W, "1/100 s", 0, 999,
         "shortest time between one direction's output off and the other's on"),
    kept("slowdly", Size::W, "1/100 s", 0, 999,
         "time without direction output when the axis comes into the slow range"),
    kept("tbrake", Size::W, "1/100 s", 0, 999, "time between the brake's release and the direction output"),
    kept("overpos", Size::W, "Um", 0, 9999, "way beyond the quota of a backlash recovery, 0 = none"),
    kept("bklashmode", Size::B, "", 0, 4,
         "backlash recovery: 0 none, 1 ends forward, 2 backward, 3 and 4 the same with the overshoot fast"),
    kept("ninert", Size::B, "", 1, 8,
         "number of bands of equal width between minpos and maxpos, 0 acts as 1"),
    kept("maxiner", Size::W, "Um/10", 0, 9999,
         "largest change of an inertia without the alert st_erin, 0 = no alert"),
    kept("toldly", Size::W, "1/100 s", 0, 9999,
         "time from the outputs' end to the judgement of a placement and st_still"),
    kept("inertmode", Size::B, "", 0, 2,
         "inertia is recalculated: 0 never, 1 after a placement out of tolerance, 2 after each"),
    kept("tool", Size::L, "Um/10", -999999, 999999, "thickness of the tool, added to setpos at START"),
    kept("setpos", Size::L, "Um", -999999, 999999,
         "quota of placements; a running one takes it while it can"),
    inertia("iner01", "way that the axis coasts in band 1; with dobiner in band 1 forward"),
    inertia("iner02", "way that the axis coasts in band 2; with dobiner in band 1 backward"),
    inertia("iner03", "way that the axis coasts in band 3; with dobiner in band 2 forward"),
    inertia("iner04", "way that the axis coasts in band 4; with dobiner in band 2 backward"),
    inertia("iner05", "way that the axis coasts in band 5; with dobiner in band 3 forward"),
    inertia("iner06", "way that the axis coasts in band 6; with dobiner in band 3 backward"),
    inertia("iner07", "way that the axis coasts in band 7; with dobiner in band 4 forward"),
    inertia("iner08", "way that the axis coasts in band 8; with dobiner in band 4 backward"),
    inertia("iner09", "with dobiner: way that the axis coasts in band 5 forward"),
    inertia("iner10", "with dobiner: way that the axis coasts in band 5 backward"),
    inertia("iner11", "with dobiner: way that the axis coasts in band 6 forward"),
    inertia("iner12", "with dobiner: way that the axis coasts in band 6 backward"),
    inertia("iner13", "with dobiner: way that the axis coasts in band 7 forward"),
    inertia("iner14", "with dobiner: way that the axis coasts in band 7 backward"),
    inertia("iner15", "with dobiner: way that the axis coasts in band 8 forward"),
    inertia("iner16", "with dobiner: way that the axis coasts in band 8 backward"),
    kept("dobiner", Size::B, "", 0, 1, "inertias: 0 one a band, 1 two a band, forward and backward"),
    kept("enstol", Size::B, "", 0, 1,
         "START in tolerance: 0 moves nothing and sets st_sttoll, 1 places again"),
    kept("prsmode", Size::B, "", 0, 2,
         "preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable without search"),
    kept("prspos", Size::L, "Um", -999999, 999999, "quota that the preset loads, minpos..maxpos"),
    kept("prsdir", Size::B, "", 0, 3,
         "preset search: 0 forward, 1 backward, fast and then slow; 2 forward, 3 backward, always slow"),
    DeviceVariable{"actiner", Size::B, "", 0, 7, read, R::retentive, {}, "inertia band in use"},
    kept("delta", Size::L, "Um", -999999, 999999, "what DELCNT adds"),
    kept("decpt", Size::B, "", 0, 3, "decimals of the unit of measure: speeds are in whole units"),
    kept("unitvel", Size::B, "", 0, 1, "time unit of speeds: 0 per minute, 1 per second"),
    shown("frq", "Hz", "frequency of one phase of the transducer over 240 ms"),
    shown("vel", "speed", "magnitude of the axis' speed, from frq's window"),
    kept("breaktype", Size::B, "", 0, 1, "brake output: 0 on to brake, 1 off to brake"),
    elsewhere("001 1.4.5", kept("slowtype", Size::B, "", 0, 2,
                                "slow range: 0 slowpos, 1 in proportion to the speed, 2 to its square")),
    elsewhere("001 1.4.5", kept("maxvel", Size::L, "speed", 0, 999999,
                                "speed at which the slow range is maxslow, if slowtype is not 0")),
    elsewhere("001 1.4.5", kept("maxslow", Size::W, "Um", 0, 9999,
                                "slow range at maxvel, and its largest, if slowtype is not 0")),
    elsewhere("001 1.4.5",
              kept("minslow", Size::W, "Um", 0, 9999, "smallest slow range, if slowtype is not 0")),
    elsewhere("001 1.4.5",
              shown("exeslow", Size::W, "Um", 0, 9999,
                    "slow range by the present speed, held from its entry on; 0 if slowtype is 0")),
};
inline constexpr auto variables = in_section("001 1.6.3", variables_rows);

inline constexpr std::array fields = {
    Field{"TCamp", Field::Kind::period_ms, 1, 255, "sampling time [ms]"},
    Field{"IQCTL", Field::Kind::counter, 0, 0, "transducer"},
    Field{"ILine", Field::Kind::interrupt_line, 1, 8, "zero pulse"},
    Field{"IAZero", Field::Kind::input, 0, 0, "enable of the preset"},
    Field{"OutAva", Field::Kind::output, 0, 0, "forward, as st_movfwd"},
    Field{"OutInd", Field::Kind::output, 0, 0, "backward, as st_movbwd"},
    Field{"OutDir", Field::Kind::output, 0, 0, "direction, on = backward, as st_movdir"},
    Field{"OutMov", Field::Kind::output, 0, 0, "movement: forward or backward"},
    Field{"OutRal", Field::Kind::output, 0, 0, "slowdown, as st_movslow"},
    Field{"OutFre", Field::Kind::output, 0, 0, "brake, as st_brake"},
};

/// Spellings of the manual's text, tables and programs beside these (spec 9.1).
inline constexpr std::array aliases = {
    Alias{"tolp", "tollp"},         Alias{"toln", "tolln"},       Alias{"tin", "tinvt"},
    Alias{"tinv", "tinvt"},         Alias{"slowly", "slowdly"},   Alias{"bkashmode", "bklashmode"},
    Alias{"cnratio", "cntratio"},   Alias{"prmdir", "prsdir"},    Alias{"prsdire", "prsdir"},
    Alias{"st_sttol", "st_sttoll"}, Alias{"movbwd", "st_movbwd"},
};

/// Where the manual of OOPOS2 leaves something open, and what the device does there (spec qem.md 10).
inline constexpr std::array readings = {
    ManualReading{"",
                  "commands wait for the next sample, which takes them as a set in the order of the table",
                  "001 1.6.2 gives priorities and 1.4.9 an overlap of two DELCNT, no mechanism"},
    ManualReading{"cntratio", "from 374, which is 0.00374 Um a pulse", "001 1.6.3 prints 347"},
    ManualReading{"toldly", "in 1/100 s", "001 1.4.4 says s/1000, 1.6.3 1/100 s"},
    ManualReading{"posit", "in motion taken where the goal stays ahead and the slow range is not entered",
                  "001 1.4.2 allows what the table of 1.6.3 does not"},
    ManualReading{
        "setpos",
        "in motion taken where it stays ahead and the slow range is not entered, else the goal stays",
        "001 1.4.2 allows what the table of 1.6.3 does not"},
    ManualReading{"slowdly",
                  "0 = no gap; a start inside the slow range switches slow and direction on together",
                  "001 1.2.2 describes the phases of a long way only"},
    ManualReading{"slowtype",
                  "2 takes the square of vel/maxvel; the range is computed anew until it is entered",
                  "001 1.4.5 prints the formula without the square below the line"},
    ManualReading{"maxiner", "watches the change of the inertia; the new value is kept anyway",
                  "001 1.6.4 compares the value, 1.6.3 the change"},
    ManualReading{
        "overpos",
        "the way of a backlash recovery alone, no least way of a placement; the overshoot stays within "
        "minpos..maxpos",
        "001 1.6.3 adds 'and/or minimum delta of positioning' and says no more of it; 1.2.3 does not speak "
        "of the limits"},
    ManualReading{
        "tool", "a quota setpos + tool beyond minpos..maxpos goes to the limit, and says so",
        "001 1.6.3 makes setpos + tool the final quota, and minpos and maxpos what the axis reaches"},
    ManualReading{
        "STOP",
        "ends at once what runs, waits toldly, brakes; no recalculation, st_toll stays 0. It comes before "
        "START",
        "001 1.6.2 lists START first and says that STOP comes first; no phases of a STOP are given"},
    ManualReading{"DELCNT", "needs st_still = 1", "001 1.6.2 prints st_still = 0, its text says stopped"},
    ManualReading{"CNTDIR", "is a command", "001 1.6.2 does not list it, the program of 1.8.2 gives it"},
};

}  // namespace drycut::devices::oopos2::table

namespace drycut::devices::oopos2 {

/// OOPOS2: on/off positioner, outputs forward, backward and slowdown by the position (001; spec qem.md 9).
inline constexpr DeviceType oopos2_type = {
    "OOPOS2",         "on/off positioner: forward, backward, slowdown and brake outputs by the position",
    table::variables, table::states,
    table::commands,  table::fields,
    table::aliases,   table::readings,
};

}  // namespace drycut::devices::oopos2
