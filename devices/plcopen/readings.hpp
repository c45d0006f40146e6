#pragma once
#include <array>

#include "devices/device.hpp"

// Where ISG's documents (004), PLCopen and IEC 61131-3 leave something open, and what Drycut does there (spec
// ecam.md B). `of` is a block, an axis parameter, "cam table" or "ST".
namespace drycut::devices::plcopen {

inline constexpr std::array readings = {
    ManualReading{"MC_CamIn",
                  "slave = SlaveScaling * cam(MasterScaling * master + MasterOffset) + SlaveOffset",
                  "004 names the inputs and gives no formula; MasterScaling is said to be whole"},
    ManualReading{"MC_CamIn",
                  "the master is a modulo axis, with pairs (tables of type 7) and ENDLESS the slave too; a "
                  "linear slave of the others is watched at its software limits",
                  "004 speaks of a linear slave, error 60181 of modulo axes"},
    ManualReading{"MC_CamIn", "both ENDLESS bits, and bits without a name, are error 65001",
                  "004 gives each bit alone"},
    ManualReading{"MC_CamIn",
                  "without HLI_CI_F_PERIODIC the slave waits where the cam is at master 0, after scaling "
                  "and offset of the master",
                  "004: \"the start position of the cam table\" and \"passes through zero\""},
    ManualReading{"MC_CamIn",
                  "one more pass is kept, however many edges of Execute arrive in a pass; a master that "
                  "passes zero backwards runs the cam backwards",
                  "004: a further edge runs the cam a further time"},
    ManualReading{"MC_CamIn",
                  "at the end of the single pass the next set position is the last one, with speed 0",
                  "004: \"stopped immediately\""},
    ManualReading{"MC_CamIn", "InSync becomes TRUE after the phasing, when slave and cam are at one position",
                  "004: \"brought to the right position\", no word on the output"},
    ManualReading{"MC_CamIn", "a coupled slave that stands is in SynchronizedMotion",
                  "004 allows both names"},
    ManualReading{"MC_CamOut", "Error is TRUE while ErrorID is not 0", "the vendor's page prints FALSE"},
    ManualReading{"MC_Phasing", "the shift is added to the running master; a slave at dynamik.vb_max lags",
                  "the vendor's page gives the limits of the shift alone"},
    ManualReading{
        "MC_Stop",
        "holds Stopping while Execute is TRUE; a movement interrupts it, MC_Halt and couplings are refused",
        "the vendor lets a movement interrupt it, PLCopen refuses all"},
    ManualReading{"MC_ReadParameter", "takes PLCopen's numbers", "the vendor's block takes names"},
    ManualReading{"MC_WriteParameter", "takes PLCopen's numbers", "the vendor's block takes names"},
    ManualReading{"cam_gear.v_diff_percent",
                  "100, in 0.1 % of the cam's speed or of a thousandth of dynamik.vb_max, "
                  "what is more: or a cam at rest would never be met",
                  "004: Default 10, without unit; the list of parameters says 100"},
    ManualReading{"cam_gear.j_vel_sync", "0 = half of a_max in tr_max", "004: from the maximum ramp time"},
    ManualReading{"cam_gear.time_out_in_window",
                  "counts from the first entry into the window; see "
                  "cam_gear.timeout_from_execute",
                  "004: maximum duration of phase 2; the list of parameters: of the synchronisation"},
    ManualReading{"getriebe[0].lslope_profil.a_grenz_stufe_1",
                  "a constant deceleration without limit of jerk", "004 names the parameter only"},
    ManualReading{"cam table",
                  "STEP_DIRECT has speed and acceleration 0 everywhere; a coupled slave takes its steps "
                  "with dynamik.vb_max",
                  "004 gives the position only"},
    ManualReading{"cam table", "POLYNOM_3 has the tangents of the neighbours at its points (Catmull-Rom)",
                  "004: \"constant-tangent, cubic Bezier\" of four points"},
    ManualReading{"cam table", "coefficients of POLYNOM_3_KOEFF are of t = 0..1 in each interval",
                  "004 gives the polynomial, not t"},
    ManualReading{"cam table",
                  "LINE_POLY5 and POLY5_LINE name the segment that arrives at the first point; they take "
                  "an even number of lines",
                  "004: \"starting with\", at the zero of the master or at the first line"},
    ManualReading{"cam table",
                  "with ENDLESS a step against the direction and longer than half a turn of the slave "
                  "is the short way round; the closing step ends on the nearest turn that way",
                  "004: the direction in which the modulo correction takes place"},
    ManualReading{
        "ST",
        "statements take no time unless the scenario gives controller.plcopen.statement_time; then a task "
        "takes its inputs at its beginning, gives its outputs at its end and is not interrupted, whatever "
        "the priority of the next; one that ends after its next beginning was due is told as the event "
        "overrun",
        "IEC 61131-3 lets tasks interrupt each other or not"},
    ManualReading{
        "ST",
        "a WSTRING holds UTF-8 and counts its characters; functions of texts give 255 characters, or as "
        "many as the longest text that is declared",
        "IEC 61131-3 leaves the length to the implementer"},
    ManualReading{
        "ST",
        "CV of CTU, CTD and CTUD is INT (0..32767) and goes into INT, UINT and WORD; PV takes all of them",
        "IEC 61131-3 has INT, CODESYS WORD"},
    ManualReading{
        "ST",
        "a reference knows what it is of: seen as another type it has the bytes, the lowest first; outside "
        "of it, or as what holds no plain data, it stops the program",
        "IEC 61131-3 has no other type behind a reference, CODESYS has addresses"},
    ManualReading{
        "ST",
        "a REAL that overflows, a conversion that does not fit and a text that is cut off are told as the "
        "event value_cut, once for each place of the program; an infinite REAL is recorded as the largest "
        "number, one that is no number as 0",
        "IEC 61131-3 calls them errors"},
    ManualReading{
        "ST",
        "a program whose scenario names no dialect is CODESYS's; where that matters it is noted, the "
        "first line of each difference",
        "IEC 61131-3 and CODESYS differ"},
    ManualReading{
        "ST", "a function that EN leaves out gives the initial value of its type, a block keeps its outputs",
        "IEC 61131-3 leaves it to the implementer"},
    ManualReading{
        "ST",
        "a STRING holds the bytes of the UTF-8 text: LEN counts two for a letter such as an umlaut, and "
        "LEFT, MID, RIGHT cut between bytes",
        "IEC 61131-3 gives no code of characters"},
    ManualReading{
        "ST", "LINT, ULINT and LWORD are exact in the program; what is recorded or checked is exact to 2^53",
        "a trace holds REAL numbers"},
    ManualReading{
        "ST",
        "%MXbyte.bit is a memory of its own; %MD5 is %MW10 and %MW11, the low word first; Modbus has them "
        "at these numbers",
        "IEC 61131-3 leaves the memory's layout to the implementer, 004 says nothing of Modbus"},
    ManualReading{"ST", "places outside of a STRING are cut off", "IEC 61131-3 calls them errors"},
    ManualReading{
        "ST",
        "whole numbers wrap without a word where they go into a variable that is too small, and on their way "
        "in the width that the dialect gives them; conversions round halves to the even number",
        "IEC 61131-3 leaves overflow to the implementer"},
    ManualReading{
        "ST",
        "TIME counts milliseconds in 32 bit, LTIME nanoseconds in 64 with a sign; TOD and LTOD begin "
        "anew at midnight",
        "IEC 61131-3 leaves range and precision to the implementer"},
    ManualReading{"ST", "AND and OR take both sides", "IEC 61131-3 lets the implementer choose"},
};

}  // namespace drycut::devices::plcopen
