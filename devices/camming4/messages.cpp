#include "devices/camming4/messages.hpp"

#include <algorithm>
#include <iterator>

namespace drycut::devices::camming4 {
namespace {

struct Message {
  int code;
  std::string_view text;
  int priority = 99;  ///< of a warning
};

constexpr Message errors[] = {
    {1, "too many sectors in sequence that take no master space"},
    {2, "jump with the slave moving onto a sector that starts from speed 0"},
    {3, "no such G code"},
    {4, "master space too small: the sector is over in less than a sample"},
    {5, "write into the running sector"},
    {6, "jump to a row outside 1..128"},
    {7, "sector 160 not at the beginning of the cam"},
    {50, "radius too small to join the two points"},
    {51, "displacements of an arc are 0 but its radius is not"},
};

constexpr Message warnings[] = {
    {1, "acceleration above taccmax", 6},
    {2, "deceleration above tdecmax", 7},
    {3, "output saturated at +10 V", 4},
    {4, "output saturated at -10 V", 5},
    {5, "final speed of the opposite sign to the initial one", 9},
    {6, "acceleration sector met with the slave moving; it starts from speed 0", 2},
    {7, "medium speed of the opposite sign to the initial one", 8},
    {8, "interrupt event delayed by a recalculation", 0},
    {9, "start quota of sector 160 already passed", 1},
    {10, "softening between sectors 154 not executed", 10},
    {11, "command refused", 11},
    {12, "slave out of syncrange", 3},
};

template <std::size_t count>
Message message(const Message (&rows)[count], int code) {
  const auto* const found = std::ranges::find(rows, code, &Message::code);
  return found == std::end(rows) ? Message{code, ""} : *found;
}

}  // namespace

std::string_view error_text(int code) { return message(errors, code).text; }
std::string_view warning_text(int code) { return message(warnings, code).text; }
int warning_priority(int code) { return message(warnings, code).priority; }

}  // namespace drycut::devices::camming4
