#pragma once
#include <array>

#include "devices/table.hpp"

// Where the manual of CAMMING4 leaves something open, and what the device does there (spec qem.md 10).
namespace drycut::devices::camming4::table {

inline constexpr std::array readings = {
    Reading{"", "commands wait for the next sample, which takes them as a set in the order of the table",
            "000 1.9.5 gives the commands in an order, no mechanism"},
    Reading{
        "",
        "recalculations of several writes follow each other: their samples add up; a row of the cam, measure "
        "and pulse, measurem and pulsem, decpt and unitvel are one each; an event waits for those before it",
        "000 1.4 gives the samples of a single parameter"},
    Reading{"", "9 rows without master space, 4 update rows in a sequence, one more is error 1",
            "000 1.2.11 and 1.2.12 say 9 and 4, 1.10 says 7 and 3"},
    Reading{"integt", "the integral action grows by the proportional action of pgain 1000 in each integt",
            "000 1.1.12.3 gives the direction of the effect, no scale"},
    Reading{"derivt",
            "the derivative action is the error's change in derivt, scaled as pgain 1000 scales the error",
            "000 1.1.12.4 gives the direction of the effect, no scale"},
    Reading{"maxpos", "written with st_still = 1",
            "000 1.9.2 prints st_still = 0, which no sound program could use"},
    Reading{"minpos", "written with st_still = 1",
            "000 1.9.2 prints st_still = 0, which no sound program could use"},
    Reading{"prspos", "written with st_still = 1",
            "000 1.9.2 prints st_still = 0, which no sound program could use"},
    Reading{"toll", "written with st_still = 1",
            "000 1.9.2 prints st_still = 0, which no sound program could use"},
    Reading{"ramptype", "of placements; written with st_still = 1",
            "000 1.9.2 prints st_still = 0 and calls cam fittings trapezoidal, 1.2 has the codes 231..254"},
    Reading{"taccmax", "0 = not watched", "000 1.9.2: the printed descriptions are shifted by a row"},
    Reading{"tdecmax", "0 = not watched", "000 1.9.2: the printed descriptions are shifted by a row"},
    Reading{"mtype", "the increments come from the new counter, positm does not jump",
            "000 1.5 allows the change in a cam, and says no more"},
    Reading{"rowex", "0..128", "000 1.9.3 prints 0..40, of an earlier device of 40 sectors"},
    Reading{"setpos", "a START beyond minpos..maxpos goes to the limit, and says so",
            "000 1.9.3 gives the range, no answer to a quota outside"},
    Reading{"codeG", "a byte of -128..-1 is a code of 128..255; 129th row: error 6, value 128",
            "000 1.1.14 keeps codes in a byte, and says nothing of a cam without end"},
    Reading{"codeQm", "in gearing positm wraps at codeQm, posit at codeQs",
            "000 1.2.3 says so, its table fixes them at half"},
    Reading{"codeQs",
            "132 and 150..153 whose space does not fit their speeds take two ramps, broken at half of the "
            "master's space; 235 always takes two cycloids",
            "000 1.2.1..1.2.3 ask for a compensation and do not give its law"},
    Reading{"codeQma",
            "softening of n = 1..4 is a ramp of 1/(n+1) of the smaller sector on both sides of the boundary",
            "000 1.2.3 gives the fractions, the picture is lost"},
    Reading{"codeQsa",
            "175 and 174 turn the tangent in degrees; 180 adds its way by a trapezoid of setvel, tacc, tdec",
            "000 1.2.4 names no unit, 1.2.12 no profile"},
    Reading{"wrncode", "a warning gives way to one of its own priority or a higher one",
            "000 1.4 calls the number a priority, and says no more"},
    Reading{"START", "needs st_still = 1", "000 1.9.5 prints st_still = 0"},
    Reading{"STARTCAM", "needs st_camex = 0", "000 1.9.5 prints st_camex = 1, 1.1.5.1 forbids it in a cam"},
    Reading{"LOOPON", "a silent no-op where the loop is closed", "000 1.9.5 prints st_loopon = 1"},
    Reading{"CALOFF", "a silent no-op where there is no calibration",
            "000 1.9.5 prints st_cal = 0; the start-up program of 1.1.1.1 gives it without"},
    Reading{"PRESETM", "needs st_prsonm = 0", "000 1.9.5 prints st_prson, the slave's"},
    Reading{"RSPRSM", "needs st_init = 1", "000 1.9.5 prints st_init = 0"},
    Reading{"PRESET",
            "needs st_still = 1, or turns a running search; with the enable already on, it begins with its "
            "slow leg, reversed",
            "000 1.9.5 prints st_still = 0; the search is described in 002 1.2.5, with the enable off"},
    Reading{"ENBL", "arms the normal input", "000 1.9.5 prints the text of CNTREV here"},
    Reading{"INTENBL", "arms the interrupt input", "000 1.9.5 prints the text of CNTDIR here"},
    Reading{"DSBL", "disarms the normal input", "000 1.9.5 prints the text of CNTLOCKM here"},
    Reading{"frqm", "what is written stays to the end of its window",
            "000 1.9.3 prints RdWr for a measured value"},
    Reading{"st_still", "stays 1 while a cam runs", "000 1.9.6: the sentence lost its object"},
    Reading{"st_sync", "the following error in a cam is at most syncrange; leaving that is warning 12",
            "000 1.9.2 and 1.4 give no measure of synchronism but syncrange"},
};

}  // namespace drycut::devices::camming4::table
