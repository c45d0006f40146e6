#include "devices/lx3vp/ecamtbx_registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr EcamtbxWord saw[] = {
    {saw_word::master_length, 2, "P1", "i32", "pulses", "1..2147483647",
     "master length of the cycle; K101: of the forward and of the return stroke each, up to 1073741823"},
    {saw_word::slave_length, 2, "P2", "i32", "pulses", "not 0",
     "slave length; K101: of a stroke; negative backwards"},
    {saw_word::sync_length, 2, "P3", "i32", "pulses", "0..|P2|", "of it in the synchronous zone"},
    {saw_word::sync_ratio, 2, "P4", "f32", "", "above 0",
     "slave pulses per master pulse in the synchronous zone"},
    {saw_word::max_ratio, 2, "P5", "f32", "", "P4 or more", "largest slave pulses per master pulse"},
    {saw_word::acceleration, 1, "P6 low", "u16", "", "0..2",
     "acceleration: 0 uniform speed (steps), 1 uniform acceleration, 2 B type"},
    {saw_word::curve, 1, "P6 high", "u16", "", "0..3, 5",
     "K100: 0 leftCAM, 1 midCAMall, 2 midCAMbegin, 3 midCAMend (stops by itself), 5 rightCAM; plus H1000 "
     "backwards"},
    {saw_word::resolution, 1, "P7", "u16", "rows", "0, 10..512", "rows of the table; 0 makes 200"},
};

constexpr EcamtbxWord s_curve[] = {
    {s_curve_word::length, 2, "P1", "i32", "pulses", "not 0", "way; negative backwards"},
    {s_curve_word::top_speed, 2, "P2", "i32", "Hz", "1..150000", "top speed"},
    {s_curve_word::acceleration, 1, "P4", "i16", "ms", "0..32767", "time of acceleration"},
    {s_curve_word::deceleration, 1, "P5", "i16", "ms", "0..32767", "time of deceleration"},
    {s_curve_word::resolution, 1, "P6", "u16", "rows", "51..512", "rows of the table"},
    {s_curve_word::last_master, 2, "P8", "i32", "100 us", "", "ECAMTBX writes it: master of the last row"},
    {s_curve_word::last_slave, 2, "P9", "i32", "pulses", "", "ECAMTBX writes it: slave of the last row"},
    {s_curve_word::uniform_time, 2, "P10", "i32", "100 us", "", "ECAMTBX writes it: time at top speed"},
    {s_curve_word::speed_reached, 2, "P11", "i32", "Hz", "", "ECAMTBX writes it: speed that is reached"},
    {s_curve_word::result, 1, "P13", "i16", "", "", "ECAMTBX writes it: the result, as in D1"},
};

constexpr BlockReading word_readings[] = {
    {"results", "the manual says only that they are below 0 on an error: the numbers are ours"},
    {"laws", "the manual names them and shows results: the profiles are derived from its demos"},
    {"P6 high 3",
     "midCAMend: word 31 of the block tells the cam to stop at the end of its cycle, whatever word 4 says"},
    {"column Default",
     "3000, 1000, 300, 5/3 are what the editor's dialog begins with: a list that nothing has written is "
     "refused"},
    {"P6 high H1000", "the demo of the negative square: the slave runs backwards"},
    {"P2, P3 with the sync function",
     "the manual gives them a second meaning and does not explain it: they stay lengths, the zone's "
     "thresholds "
     "go to words 9 to 12 of the block"},
    {"P7 0", "the manual's demo: 200 rows"},
    {"P6 of K101", "the low word chooses the ramps; the high word is ignored, as the demo says"},
    {"K0 and K1", "the manual does not tell them apart: K0 accelerates by a cosine, K1 by parabolas"},
    {"initial values", "words of the block that nothing has written get them (see DECAM)"},
};

}  // namespace

std::span<const BlockReading> ecamtbx_readings() { return word_readings; }
std::span<const EcamtbxWord> saw_words() { return saw; }
std::span<const EcamtbxWord> s_curve_words() { return s_curve; }

}  // namespace drycut::devices::lx3vp
