#include "devices/camming4/sector.hpp"

#include <algorithm>

namespace drycut::devices::camming4 {
namespace {

constexpr auto movement = CodeClass::movement;
constexpr auto update = CodeClass::count_update;
constexpr auto none = Use::unused;
constexpr auto M = Use::master_space;
constexpr auto S = Use::slave_space;
constexpr auto Sb = Use::slave_space_bits;
constexpr auto R = Use::radius;
constexpr auto X = Use::displacement_x;
constexpr auto Y = Use::displacement_y;
constexpr auto done = Use::master_done;

}  // namespace

const std::array<Code, 39> codes{{
    {130, "NOP", CodeClass::no_operation, false, false, none, none, none, none, "does nothing"},
    {131, "AZL", movement, false, true, M, S, none, none,
     "accelerates from standstill; the spaces fix the end speed"},
    {132, "AZM", movement, false, true, M, S, none, none,
     "accelerates from standstill to the master's speed"},
    {133, "RSC", movement, false, false, M, S, none, none,
     "one ramp from the present speed; the spaces fix the end speed"},
    {134, "RCC", movement, false, false, M, S, none, none,
     "makes up a space in two ramps and returns to the present speed"},
    {135, "DZC", movement, false, false, M, S, none, none,
     "decelerates to standstill in two ramps that fit the space"},
    {136, "END", CodeClass::end, false, false, none, none, none, none,
     "leaves the cam, the slave holds its position"},
    {137, "ABJ", CodeClass::jump, false, false, Use::target_row, none, none, none, "goes on at another row"},
    {138, "LOOP", CodeClass::loop, false, false, none, none, none, none,
     "goes on at row 1, executed spaces taken off the counts"},
    {139, "SMS", update, false, false, Use::master_count, Use::slave_count, none, none,
     "takes spaces off both counts"},
    {140, "NCM", update, false, false, Use::master_count, none, none, none, "sets the master count"},
    {141, "NCS", update, false, false, none, Use::slave_count, none, none, "sets the slave count"},
    {142, "NMS", update, false, false, Use::master_count, Use::slave_count, none, none, "sets both counts"},
    {143, "SBMS", update, false, false, Use::master_count_bits, Use::slave_count_bits, none, none,
     "takes bits off both counts"},
    {144, "NBM", update, false, false, Use::master_count_bits, none, none, none,
     "sets the master count in bits"},
    {145, "NBS", update, false, false, none, Use::slave_count_bits, none, none,
     "sets the slave count in bits"},
    {146, "NBMS", update, false, false, Use::master_count_bits, Use::slave_count_bits, none, none,
     "sets both counts in bits"},
    {150, "AZMC", movement, false, true, M, S, M, Sb,
     "accelerates over the auxiliary spaces to the ratio of the main ones, then runs those"},
    {151, "DZMC", movement, false, false, M, S, M, Sb,
     "runs the main spaces in one ramp, then decelerates to standstill over the auxiliary ones"},
    {152, "AZMS", movement, false, true, Use::master_coefficient, Use::slave_coefficient, M, Sb,
     "accelerates from standstill to a ratio over the auxiliary spaces"},
    {153, "NVSR", movement, false, false, Use::master_coefficient, Use::slave_coefficient, M, Sb,
     "changes to a ratio over the auxiliary spaces"},
    {154, "NVS", movement, false, false, M, S, Use::softening, Use::sector_type,
     "steps to a ratio, softened on request; as gearing until released"},
    {160, "STS", CodeClass::start_sync, false, false, Use::master_quota, none, none, none,
     "waits until the master passes a quota"},
    {170, "HS", movement, false, false, R, X, done, Y, "x axis of a clockwise arc"},
    {171, "US", movement, false, false, R, X, done, Y, "x axis of a counterclockwise arc"},
    {172, "HC", movement, false, false, R, X, done, Y, "y axis of a clockwise arc"},
    {173, "UC", movement, false, false, R, X, done, Y, "y axis of a counterclockwise arc"},
    {174, "HT", movement, false, false, R, X, done, Y, "tangent axis of a clockwise arc"},
    {175, "UT", movement, false, false, R, X, done, Y, "tangent axis of a counterclockwise arc"},
    {180, "RSV", CodeClass::recovery, false, false, none, S, none, none,
     "moves the slave by a correction beside the cam"},
    {190, "CNJ", CodeClass::conditional_jump, false, false, Use::target_row, Use::times, Use::times_done,
     none, "goes on at another row a number of times"},
    {231, "AZLE", movement, true, true, M, S, none, none, "as 131 with a cycloidal ramp"},
    {232, "AZME", movement, true, true, M, S, none, none, "as 132 with cycloidal ramps"},
    {233, "RSCE", movement, true, false, M, S, none, none, "as 133 with a cycloidal ramp"},
    {234, "RCCE", movement, true, false, M, S, none, none, "as 134 with cycloidal ramps"},
    {235, "DZCE", movement, true, false, M, S, none, none, "as 135 with cycloidal ramps"},
    {252, "AZMSE", movement, true, true, Use::master_coefficient, Use::slave_coefficient, M, Sb,
     "as 152 with cycloidal ramps"},
    {253, "NVSRE", movement, true, false, Use::master_coefficient, Use::slave_coefficient, M, Sb,
     "as 153 with cycloidal ramps"},
    {254, "NVSE", movement, true, false, M, S, Use::softening, Use::sector_type,
     "as 154 with cycloidal softening"},
}};

const Code* find_code(int code) {
  const auto* found = std::lower_bound(codes.begin(), codes.end(), code,
                                       [](const Code& entry, int wanted) { return entry.code < wanted; });
  return found != codes.end() && found->code == code ? found : nullptr;
}

std::string_view unit_of(Use use) {
  switch (use) {
    case Use::slave_space_bits:
    case Use::master_count_bits:
    case Use::slave_count_bits:
      return "bits x4";
    case Use::master_space:
    case Use::slave_space:
    case Use::master_count:
    case Use::slave_count:
    case Use::master_quota:
    case Use::radius:
    case Use::displacement_x:
    case Use::displacement_y:
    case Use::master_done:
      return "Um";
    default:
      return "";
  }
}

}  // namespace drycut::devices::camming4
