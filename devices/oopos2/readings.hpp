#pragma once
#include <array>

#include "devices/table.hpp"

// Where the manual of OOPOS2 leaves something open, and what the device does there (spec qem.md 10).
namespace drycut::devices::oopos2::table {

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
