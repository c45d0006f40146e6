#pragma once
#include <array>
#include <string_view>

namespace drycut::devices::qmove {

/// A form of the QCL or of the configuration, for `drycut devices QMOVE`. The manuals of the devices show the
/// language in their programs and do not define it: `reading` says what is ours, and what it rests on.
struct QclRow {
  std::string_view form;
  std::string_view meaning;
  std::string_view reading = {};
};

inline constexpr std::string_view ours = "in no manual (000 1.1, 001 1.8, 002 1.6 show programs): ours";
inline constexpr std::string_view public_word = "in no manual; the maker's public pages name it";
inline constexpr std::string_view closing =
    "the maker's public pages show how it opens; how it closes is ours";

inline constexpr std::array language{
    QclRow{"name = e",
           "stores; flags, bytes and words wrap, which a note tells of constants and what is made "
           "of them; a single loses its fraction in a whole number",
           "how values wrap is not in the manuals"},
    QclRow{"name[i]  name[i, j]",
           "an element, from 1; outside: error 3, 4 (recipe) or 5 (step), all tasks stop"},
    QclRow{"Device:parameter = e", "waits for the device's next sample; before INIT it is taken at once"},
    QclRow{
        "COMMAND Device",
        "waits for the device's next sample, which takes commands in the table's order; "
        "two of the same are one; opposite ones are told as the event contradiction",
        "the manuals give priorities and the overlap of two DELCNT (001 1.4.9, 002 1.3.4.2), no mechanism"},
    QclRow{"Device:parameter",
           "a read; its statement waits for the sample that takes what was posted to the "
           "device before, by any task, never for what is posted later",
           "002 1.3.4.2 asks for a read between two DELCNT, and does not say how it waits"},
    QclRow{"+ - * /  EQ  AND OR NOT",
           "arithmetic in 32 bits, wraps, which a note tells of constants; division cuts off; by 0: "
           "error 6"},
    QclRow{"% LT LE GT GE ANDB ORB XORB NOTB", "remainder, comparisons, bits", public_word},
    QclRow{"NEQ NE", "not equal", ours},
    QclRow{"order of operators", "signs and NOT, * / %, + -, comparisons, ANDB, XORB, ORB, AND, OR",
           "the manuals give no order; WAIT NOT a AND b of their programs reads (NOT a) AND b"},
    QclRow{"IF e / ELSE / ENDIF", "parentheses round e or none"},
    QclRow{"WAIT e",
           "ends the task's turn; from the next turn on e is evaluated, once a turn, until it holds",
           "that it ends the turn even where e holds is ours: the manuals' loops end in WAIT 1"},
    QclRow{"JUMP label / label:", "goes on there"},
    QclRow{"END", "the task ends"},
    QclRow{"WHILE e / ENDWHILE", "loops while e holds", closing},
    QclRow{"FOR (i = a, e, step) / NEXT", "loops; the step is a number to add or an assignment", closing},
    QclRow{"SUB name / ENDSUB / CALL name", "a subroutine; 33 calls in each other are error 9", ours},
    QclRow{"; ASSERT e", "in a SUB TEST_...: drycut test asks whether e holds; a comment to all else", ours},
    QclRow{"SETOUT name", "switches an output on", public_word},
    QclRow{"RESOUT name", "switches an output off", ours},
    QclRow{"timer = n", "starts the timer for n ms; it reads 1 when they are over, and before it was started",
           ours},
    QclRow{"tasks", "each module is a task; every cycle each has one turn, in the scenario's order",
           "the manuals say nothing of several tasks"},
    QclRow{"time of a statement",
           "0 unless the scenario gives controller.qmove.statement_time: then each statement and each look "
           "at a WAIT takes it and acts at its end; a round that lasts longer than the cycle is followed at "
           "once by the next",
           "in no manual; QMOS tells the times of tasks in 0.1 ms"},
    QclRow{"watchdog",
           "1000000 instructions in a turn, a write or command to a device counting 100, are error 8 "
           "with its line; 1 s without WAIT in reads that wait is told as the event held_up",
           "the manuals say nothing of it"},
    QclRow{"names", "any case; Device.parameter as Device:parameter; 2.IN1 and 2.OUT3 as 2.INP01 and 2.OUT03",
           "the manuals' programs mix the spellings"},
};

/// Sections of a .CNF file.
inline constexpr std::array configuration_sections{
    QclRow{"CONST", "name value: a number; with a decimal point a single, else a long"},
    QclRow{"SYSTEM", "name size: a variable that keeps its value without power"},
    QclRow{"GLOBAL", "name size: a variable that is 0 at each start"},
    QclRow{"ARRSYS", "name size length: an array that keeps its values; the first element is 1", public_word},
    QclRow{"ARRGBL", "name size length: an array that is 0 at each start", public_word},
    QclRow{"TIMER", "name: a timer; a task starts it with a number of ms", public_word},
    QclRow{"DATAGROUP",
           "a name; DATAPROGRAM and a number of recipes, below it name size: one value a recipe, "
           "name[recipe]; STEP and a number of steps, below it name size: name[recipe, step]; all keep "
           "their values",
           "000 1.1.14 shows a group, no rules"},
    QclRow{"BUS", "slot card version: what stands in the rack; 3 . and 3 : are an empty slot"},
    QclRow{"INPUT", "name size terminal: a flag with a name at a terminal"},
    QclRow{"OUTPUT", "name size terminal: a flag with a name at a terminal"},
    QclRow{"INTDEVICE",
           "name type fields: a device; its type's page has the fields in their order, all on one line"},
    QclRow{"END", "the end of the file"},
};

/// What stands in an entry of a .CNF file.
inline constexpr std::array configuration_words{
    QclRow{"F B W L S",
           "size: a flag; a byte, -128..127; a word, -32768..32767; a long, 32 bit; a single, 32 bit"},
    QclRow{"2.CNT01", "counter 1 of slot 2; slot 1 is the CPU, its counters are simulated"},
    QclRow{"2.INP01  2.OUT01  2.AN01", "a digital input, a digital output, an analogue output"},
    QclRow{"1", "in a device's field for a zero pulse: interrupt line 1, INT1 in the wiring; lines 1 to 8"},
    QclRow{"X.X  X", "no terminal, no interrupt line"},
    QclRow{"0004", "4: all numbers are decimal"},
    QclRow{"names", "letters, digits and _, in any case"},
    QclRow{"CAMMING4 record", "eleven fields: CountMB is missing, and unused",
           "000 1.1.1 has twelve fields, its example 1.1.1.1 eleven"},
};

}  // namespace drycut::devices::qmove
