#include "renders/palette.hpp"

#include <fmt/format.h>

#include "renders/decimate.hpp"

namespace drycut::renders {

PlotLook look_of(const Curve& curve, std::size_t index) {
  static const std::array<Dash, 5> dashes = {Dash{}, {7, 5}, {2, 4}, {9, 4, 2, 4}, {9, 4, 2, 4, 2, 4}};
  constexpr Tone faint = {0xb9c2cc, 0x56606b};
  const bool is_line = curve.style != Curve::Style::points;
  // One with a name is told from another that lies on it by what shows at both sides.
  const double line = curve.faint && !curve.label.empty() ? 6 : 2;
  const double size = is_line ? line : curve.faint ? 1.8 : 2.8;
  return {curve.faint ? faint : kCurves[index % kCurves.size()], 0.35, size,
          dashes[index / kCurves.size() % dashes.size()]};
}

PlotLook look_of(const Band& band, std::size_t index) {
  constexpr std::array tones = {Tone{0xe8c400}, kCurves[5], Tone{0x8a8f98}};
  if (band.low == band.high) return {kStrong, 1, 1.6, {7, 5}};
  return {tones[index % tones.size()], 0.22};
}

PlotLook look_of(const Zone& zone, std::size_t index) {
  if (zone.strong) return {{0xd3efe2, 0x17423a}};
  return {{0xf0f3f6, 0x262d33}, index % 2 == 0 ? 1.0 : 0.0};
}

PlotLook look_of(const Mark& mark) {
  return {mark.strong ? kStrong : kAxis, 1, mark.strong ? 1.4 : 0.7, {2, 4}};
}

PlotLook look_of(const Lane& /*lane*/, std::size_t index) {
  constexpr std::size_t dark_enough = 4;
  return {kCurves[index % dark_enough], 0.30, 2};
}

std::map<double, Tone> state_tones(const Lane& lane) {
  // The states' numbers stand on them.
  constexpr std::array tones = {Tone{0xcfe6f5, 0x24485c}, Tone{0xfbdcc4, 0x5c3a22}, Tone{0xc5ebdf, 0x1f4d40},
                                Tone{0xf3dcea, 0x5a3f50}, Tone{0xfbe8b9, 0x5c4a1c}, Tone{0xdadfe4, 0x3c444c},
                                Tone{0xe3dcf6, 0x443d5c}};
  std::map<double, Tone> found;
  for (const LaneState& state : lane_states(lane)) found[state.value];
  std::size_t order = 0;
  for (auto& [value, tone] : found) tone = tones[order++ % tones.size()];
  return found;
}

std::string palette_css() {
  std::string css = ":root {";
  for (std::size_t i = 0; i < kCurves.size(); ++i)
    css +=
        fmt::format(" --curve-{}: light-dark(#{:06x}, #{:06x});", i + 1, kCurves[i].light, kCurves[i].dark);
  return css + " }\n";
}

}  // namespace drycut::renders
