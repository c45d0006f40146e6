#pragma once
#include <array>

#include "devices/table.hpp"

// Where the manual of EPICPOS leaves something open, and what EPICPOS and EANPOS do there (spec qem.md 10).
namespace drycut::devices::epicpos::table {

inline constexpr std::array readings = {
    Reading{"", "commands wait for the next sample, which takes them as a set in the order of the table",
            "002 1.4.2 gives priorities and 1.3.4.2 an overlap of two DELCNT, no mechanism"},
    Reading{"cntratio", "from 374, which is 0.00374 Um a pulse", "002 1.4.3 prints 347, 1.2.1 means 0.00374"},
    Reading{"toll", "from 0", "002 1.4.3 prints a range from -999999 for a distance"},
    Reading{"offset", "-32768..32767", "002 1.4.3: the range is cut off in print"},
    Reading{"integt", "the integral action grows by the proportional action of pgain 1000 in each integt",
            "002 1.2.4.3 gives the direction of the effect, no scale"},
    Reading{"derivt",
            "the derivative action is the error's change in derivt, scaled as pgain 1000 scales the error",
            "002 1.2.4.4 gives the direction of the effect, no scale"},
    Reading{"integ", "the integral action is limited to +-1024 bits",
            "002 1.4.3 prints the range 0..1024 only"},
    Reading{"derreg", "the derivative action is limited to +-1024 bits",
            "002 1.4.3 prints the range 0..1024 only"},
    Reading{"setvel", "a value that comes in a ramp waits for its end",
            "002 1.5 allows a change at constant speed only, 1.3.3 before the final deceleration"},
    Reading{"setpos", "a START beyond minpos..maxpos goes to the limit, and says so",
            "002 1.4.3 gives the range, no answer to a quota outside"},
    Reading{"START", "needs st_cal = 0 where the print repeats st_emrg = 0",
            "002 1.4.2 prints st_emrg twice"},
    Reading{"PRESET", "with the enable already on, the search begins with its slow leg, reversed",
            "002 1.2.5.2 begins with the enable off"},
    Reading{"MANFW", "needs st_emrg = 0 and st_cal = 0 too", "002 1.4.2 does not name them"},
    Reading{"MANBW", "needs st_emrg = 0 and st_cal = 0 too", "002 1.4.2 does not name them"},
    Reading{"REGOFF", "turns regulation off",
            "002 1.4.2: the titles of REGOFF and REGON are exchanged in print"},
    Reading{"REGON", "turns regulation on",
            "002 1.4.2: the titles of REGOFF and REGON are exchanged in print"},
};

}  // namespace drycut::devices::epicpos::table
