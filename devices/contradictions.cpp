#include "devices/contradictions.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace drycut::devices {
namespace {

// What begins a movement, and the command that ends it. The tables' effects do not say so: movements end by
// themselves too.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> movements{{
    {"START", "STOP"},
    {"PRESET", "STOP"},
    {"MANFW", "STOP"},
    {"MANBW", "STOP"},
    {"MANFFW", "STOP"},
    {"MANFBW", "STOP"},
    {"MANSFW", "STOP"},
    {"MANSBW", "STOP"},
    {"STARTCAM", "STOPCAM"},
    {"PRESETM", "RSPRSM"},
}};

// A search of the master's preset moves nothing.
bool moves(std::string_view command) {
  return command != "PRESETM" &&
         std::ranges::any_of(movements, [&](const auto& row) { return row.first == command; });
}

bool ends(std::string_view end, std::string_view movement) {
  return std::ranges::any_of(movements,
                             [&](const auto& row) { return row.first == movement && row.second == end; });
}

bool contradict(const DeviceCommand& a, const DeviceCommand& b) {
  if (a.effect.state >= 0 && a.effect.state == b.effect.state && a.effect.on != b.effect.on) return true;
  return ends(a.name, b.name) || ends(b.name, a.name) || (a.name != b.name && moves(a.name) && moves(b.name));
}

}  // namespace

std::vector<std::uint64_t> contradictions(const DeviceType& type) {
  std::vector<std::uint64_t> all(type.commands.size(), 0);
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b)
      if (contradict(type.commands[a], type.commands[b])) all[a] |= std::uint64_t{1} << b;
  return all;
}

}  // namespace drycut::devices
