#pragma once
#include <array>
#include <string_view>

#include "devices/table.hpp"

// The public face of OOPOS2 (001 1.6; spec qem.md 9, with the print's slips corrected as D1 and D34 say).
namespace drycut::devices::oopos2::table {

using R = Retention;
using enum Access;

inline constexpr std::array states = {
    State{"st_init", R::zero, "the device is initialised and runs", "001 1.6.4"},
    State{"st_cntlock", R::retentive, "the count is locked", "001 1.6.4"},
    State{"st_cntrev", R::retentive, "the count is reversed", "001 1.6.4"},
    State{"st_movfwd", R::zero, "the forward output is on", "001 1.6.4"},
    State{"st_movbwd", R::zero, "the backward output is on", "001 1.6.4"},
    State{"st_movslow", R::zero, "the slowdown output is on", "001 1.6.4"},
    State{"st_toll", R::zero, "the last placement ended in tolerance, or a START found the axis there",
          "001 1.6.4"},
    State{"st_brake", R::zero, "level of the brake output: what brakes is breaktype's", "001 1.6.4"},
    State{"st_movdir", R::zero, "direction of the last movement, 1 = backward", "001 1.6.4"},
    State{"st_still", R::one, "no movement runs", "001 1.6.4"},
    State{"st_erin", R::zero, "the last recalculation changed the inertia by more than maxiner", "001 1.6.4"},
    State{"st_sttoll", R::zero, "the last movement command was a START in tolerance, and nothing moved",
          "001 1.6.4"},
    State{"st_prsok", R::zero, "the count has been preset", "001 1.6.4"},
    State{"st_prson", R::zero, "the preset search runs", "001 1.6.4"},
    State{"st_regoff", R::zero, "regulation off: the movement outputs are left to others, no movement",
          "001 1.6.4"},
};

inline constexpr Needs<states> needs;
inline constexpr Turns<states, false> turns;

inline constexpr Condition any = {};
inline constexpr Condition initialised = needs({"st_init"});
inline constexpr Condition below = needs({"st_init", "!st_regoff"}, "posit < maxpos");
inline constexpr Condition above = needs({"st_init", "!st_regoff"}, "posit > minpos");

inline constexpr std::array commands = {
    Command{"INIT", needs({"!st_init"}), "computes the parameters and starts the device", "001 1.6.2"},
    Command{"STOP", needs({"st_init", "!st_regoff"}),
            "switches the movement outputs off; the axis is still after toldly", "001 1.6.2"},
    Command{"START", needs({"st_init", "!st_regoff", "st_still"}), "places the axis at setpos plus tool",
            "001 1.6.2"},
    Command{"CNTLOCK", initialised, "stops counting the transducer; no preset is loaded", "001 1.6.2",
            turns("st_cntlock")},
    Command{"CNTUNLOCK", initialised, "counts the transducer again", "001 1.6.2", turns("!st_cntlock")},
    Command{"CNTREV", initialised, "reverses the counting direction", "001 1.6.2", turns("st_cntrev")},
    Command{"CNTDIR", initialised, "restores the counting direction", "001 1.8.2", turns("!st_cntrev")},
    Command{"PRESET", needs({"st_init", "!st_regoff"}),
            "starts the preset search; while it runs, turns its direction", "001 1.6.2"},
    Command{"MANSFW", below, "runs forward slowly until STOP, at most to maxpos", "001 1.6.2"},
    Command{"MANSBW", above, "runs backward slowly until STOP, at most to minpos", "001 1.6.2"},
    Command{"MANFFW", below, "runs forward until STOP, at most to maxpos", "001 1.6.2"},
    Command{"MANFBW", above, "runs backward until STOP, at most to minpos", "001 1.6.2"},
    Command{"REGON", initialised, "takes the movement outputs", "001 1.6.2", turns("!st_regoff")},
    Command{"REGOFF", initialised, "ends any movement and leaves the movement outputs to other devices",
            "001 1.6.2", turns("st_regoff")},
    Command{"DELCNT", needs({"st_init", "st_still"}), "adds delta to posit, remainder kept", "001 1.6.2"},
};

/// iner01 to iner16: a row each, as the manual names them.
consteval Variable inertia(std::string_view name, std::string_view meaning) {
  return {name, Size::W, "Um/10", 0, 32767, read_write, R::retentive, any, meaning, "001 1.4.6"};
}

inline constexpr std::array variables = {
    Variable{"cntratio", Size::L, "Um/pulse x 1e5", 374, 400000, read_write, R::retentive, any,
             "resolution: 100000 times the Um of one transducer pulse (4 bits)", "001 1.6.3"},
    Variable{"posit", Size::L, "Um", -999999, 999999, read_write, R::retentive,
             needs({"st_init"}, "the quota ahead and not in the slow range, while a placement runs"),
             "position of the axis", "001 1.6.3"},
    Variable{"minpos", Size::L, "Um", -999999, 999999, read_write, R::retentive, any,
             "smallest quota of placements and manual movements", "001 1.6.3"},
    Variable{"maxpos", Size::L, "Um", -999999, 999999, read_write, R::retentive, any,
             "largest quota of placements and manual movements", "001 1.6.3"},
    Variable{"slowpos", Size::W, "Um", 0, 9999, read_write, R::retentive, any,
             "slow range: way before the quota in which the slowdown output is on, if slowtype is 0",
             "001 1.6.3"},
    Variable{"tollp", Size::W, "Um/10", 0, 9999, read_write, R::retentive, any,
             "largest excess over the quota in tolerance", "001 1.6.3"},
    Variable{"tolln", Size::W, "Um/10", 0, 9999, read_write, R::retentive, any,
             "largest shortage of the quota in tolerance", "001 1.6.3"},
    Variable{"tinvt", Size::W, "1/100 s", 0, 999, read_write, R::retentive, any,
             "shortest time between one direction's output off and the other's on", "001 1.6.3"},
    Variable{"slowdly", Size::W, "1/100 s", 0, 999, read_write, R::retentive, any,
             "time without direction output when the axis comes into the slow range", "001 1.6.3"},
    Variable{"tbrake", Size::W, "1/100 s", 0, 999, read_write, R::retentive, any,
             "time between the brake's release and the direction output", "001 1.6.3"},
    Variable{"overpos", Size::W, "Um", 0, 9999, read_write, R::retentive, any,
             "way beyond the quota of a backlash recovery, 0 = none", "001 1.6.3"},
    Variable{
        "bklashmode", Size::B, "", 0, 4, read_write, R::retentive, any,
        "backlash recovery: 0 none, 1 ends forward, 2 backward, 3 and 4 the same with the overshoot fast",
        "001 1.6.3"},
    Variable{"ninert", Size::B, "", 1, 8, read_write, R::retentive, any,
             "number of bands of equal width between minpos and maxpos, 0 acts as 1", "001 1.6.3"},
    Variable{"maxiner", Size::W, "Um/10", 0, 9999, read_write, R::retentive, any,
             "largest change of an inertia without the alert st_erin, 0 = no alert", "001 1.6.3"},
    Variable{"toldly", Size::W, "1/100 s", 0, 9999, read_write, R::retentive, any,
             "time from the outputs' end to the judgement of a placement and st_still", "001 1.6.3"},
    Variable{"inertmode", Size::B, "", 0, 2, read_write, R::retentive, any,
             "inertia is recalculated: 0 never, 1 after a placement out of tolerance, 2 after each",
             "001 1.6.3"},
    Variable{"tool", Size::L, "Um/10", -999999, 999999, read_write, R::retentive, any,
             "thickness of the tool, added to setpos at START", "001 1.6.3"},
    Variable{"setpos", Size::L, "Um", -999999, 999999, read_write, R::retentive, any,
             "quota of placements; a running one takes it while it can", "001 1.6.3"},
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
    Variable{"dobiner", Size::B, "", 0, 1, read_write, R::retentive, any,
             "inertias: 0 one a band, 1 two a band, forward and backward", "001 1.6.3"},
    Variable{"enstol", Size::B, "", 0, 1, read_write, R::retentive, any,
             "START in tolerance: 0 moves nothing and sets st_sttoll, 1 places again", "001 1.6.3"},
    Variable{
        "prsmode", Size::B, "", 0, 2, read_write, R::retentive, any,
        "preset: 0 at the enable's release, 1 at the zero pulse after it, 2 at the enable without search",
        "001 1.6.3"},
    Variable{"prspos", Size::L, "Um", -999999, 999999, read_write, R::retentive, any,
             "quota that the preset loads, minpos..maxpos", "001 1.6.3"},
    Variable{"prsdir", Size::B, "", 0, 3, read_write, R::retentive, any,
             "preset search: 0 forward, 1 backward, fast and then slow; 2 forward, 3 backward, always slow",
             "001 1.6.3"},
    Variable{"actiner", Size::B, "", 0, 7, read, R::retentive, any, "inertia band in use", "001 1.6.3"},
    Variable{"delta", Size::L, "Um", -999999, 999999, read_write, R::retentive, any, "what DELCNT adds",
             "001 1.6.3"},
    Variable{"decpt", Size::B, "", 0, 3, read_write, R::retentive, any,
             "decimals of the unit of measure: speeds are in whole units", "001 1.6.3"},
    Variable{"unitvel", Size::B, "", 0, 1, read_write, R::retentive, any,
             "time unit of speeds: 0 per minute, 1 per second", "001 1.6.3"},
    Variable{"frq", Size::L, "Hz", lowest, highest, read, R::zero, any,
             "frequency of one phase of the transducer over 240 ms", "001 1.6.3"},
    Variable{"vel", Size::L, "speed", lowest, highest, read, R::zero, any,
             "magnitude of the axis' speed, from frq's window", "001 1.6.3"},
    Variable{"breaktype", Size::B, "", 0, 1, read_write, R::retentive, any,
             "brake output: 0 on to brake, 1 off to brake", "001 1.6.3"},
    Variable{"slowtype", Size::B, "", 0, 2, read_write, R::retentive, any,
             "slow range: 0 slowpos, 1 in proportion to the speed, 2 to its square", "001 1.4.5"},
    Variable{"maxvel", Size::L, "speed", 0, 999999, read_write, R::retentive, any,
             "speed at which the slow range is maxslow, if slowtype is not 0", "001 1.4.5"},
    Variable{"maxslow", Size::W, "Um", 0, 9999, read_write, R::retentive, any,
             "slow range at maxvel, and its largest, if slowtype is not 0", "001 1.4.5"},
    Variable{"minslow", Size::W, "Um", 0, 9999, read_write, R::retentive, any,
             "smallest slow range, if slowtype is not 0", "001 1.4.5"},
    Variable{"exeslow", Size::W, "Um", 0, 9999, read, R::zero, any,
             "slow range by the present speed, held from its entry on; 0 if slowtype is 0", "001 1.4.5"},
};

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
    Reading{"", "commands wait for the next sample, which takes them as a set in the order of the table",
            "001 1.6.2 gives priorities and 1.4.9 an overlap of two DELCNT, no mechanism"},
    Reading{"cntratio", "from 374, which is 0.00374 Um a pulse", "001 1.6.3 prints 347"},
    Reading{"toldly", "in 1/100 s", "001 1.4.4 says s/1000, 1.6.3 1/100 s"},
    Reading{"posit", "in motion taken where the goal stays ahead and the slow range is not entered",
            "001 1.4.2 allows what the table of 1.6.3 does not"},
    Reading{"setpos",
            "in motion taken where it stays ahead and the slow range is not entered, else the goal stays",
            "001 1.4.2 allows what the table of 1.6.3 does not"},
    Reading{"slowdly", "0 = no gap; a start inside the slow range switches slow and direction on together",
            "001 1.2.2 describes the phases of a long way only"},
    Reading{"slowtype", "2 takes the square of vel/maxvel; the range is computed anew until it is entered",
            "001 1.4.5 prints the formula without the square below the line"},
    Reading{"maxiner", "watches the change of the inertia; the new value is kept anyway",
            "001 1.6.4 compares the value, 1.6.3 the change"},
    Reading{"overpos", "an overshoot stays within minpos..maxpos", "001 1.2.3 does not speak of the limits"},
    Reading{
        "STOP",
        "ends at once what runs, waits toldly, brakes; no recalculation, st_toll stays 0. It comes before "
        "START",
        "001 1.6.2 lists START first and says that STOP comes first; no phases of a STOP are given"},
    Reading{"DELCNT", "needs st_still = 1", "001 1.6.2 prints st_still = 0, its text says stopped"},
    Reading{"CNTDIR", "is a command", "001 1.6.2 does not list it, the program of 1.8.2 gives it"},
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
