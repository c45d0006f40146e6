#include "devices/camming4/messages.hpp"

#include <array>

namespace drycut::devices::camming4 {
namespace {

struct Warning {
  int priority;
  std::string_view text;
};

constexpr std::array<Warning, 13> warnings = {{
    {99, ""},
    {6, "acceleration above taccmax"},
    {7, "deceleration above tdecmax"},
    {4, "output saturated at +10 V"},
    {5, "output saturated at -10 V"},
    {9, "final speed of the opposite sign to the initial one"},
    {2, "acceleration sector met with the slave moving; it starts from speed 0"},
    {8, "medium speed of the opposite sign to the initial one"},
    {0, "interrupt event delayed by a recalculation"},
    {1, "start quota of sector 160 already passed"},
    {10, "softening between sectors 154 not executed"},
    {11, "command refused"},
    {3, "slave out of syncrange"},
}};

}  // namespace

std::string_view error_text(int code) {
  switch (code) {
    case 1:
      return "too many sectors in sequence that take no master space";
    case 2:
      return "jump with the slave moving onto a sector that starts from speed 0";
    case 3:
      return "no such G code";
    case 4:
      return "master space too small: the sector is over in less than a sample";
    case 5:
      return "write into the running sector";
    case 6:
      return "jump to a row outside 1..128";
    case 7:
      return "sector 160 not at the beginning of the cam";
    case 50:
      return "radius too small to join the two points";
    case 51:
      return "displacements of an arc are 0 but its radius is not";
    default:
      return "";
  }
}

std::string_view warning_text(int code) {
  return code > 0 && code < static_cast<int>(warnings.size()) ? warnings[static_cast<std::size_t>(code)].text
                                                              : "";
}

int warning_priority(int code) {
  return code > 0 && code < static_cast<int>(warnings.size())
             ? warnings[static_cast<std::size_t>(code)].priority
             : warnings[0].priority;
}

}  // namespace drycut::devices::camming4
