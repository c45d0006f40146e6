#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

#include "renders/cairo_image.hpp"
#include "renders/plots.hpp"

namespace drycut::renders {

// The one look of plots: pictures, reports and the live line.

/// A colour, 0xrrggbb: of pictures and light pages, and of dark pages.
struct Tone {
  unsigned light = 0;
  unsigned dark = light;
  constexpr operator Ink() const { return ink(light); }  // NOLINT(google-explicit-constructor)
};
using Dash = std::vector<double>;  ///< on, off, ... [pixels]; empty: a line without gaps

inline constexpr Tone kPaper = {0xffffff};
inline constexpr Tone kText = {0x1f2933};
inline constexpr Tone kSoftText = {0x52606d};
inline constexpr Tone kAxis = {0x7b8794};
inline constexpr Tone kGrid = {0xdfe3e8};
inline constexpr Tone kStrong = {0xb3261e, 0xff9a91};  ///< faults, limits
inline constexpr Tone kMixed = {0x8a8f98};             ///< states too short to be told apart
/// Okabe and Ito's palette: told apart with any colour vision. After its end the lines are dashed.
inline constexpr std::array kCurves = {
    Tone{0x0072b2, 0x56b4e9}, Tone{0xd55e00, 0xff8f4a}, Tone{0x009e73, 0x2ec79b}, Tone{0xcc79a7, 0xe8a3cb},
    Tone{0xe69f00, 0xf0bb4a}, Tone{0x56b4e9, 0x8fd0f5}, Tone{0x333333, 0xc0c6cc}};

/// How something of a plot is drawn.
struct PlotLook {
  Tone tone;
  double opacity = 1;  ///< of what is filled
  double size = 0;     ///< of a line, radius of a dot [pixels]; 0: it is filled
  Dash dash = {};
};
PlotLook look_of(const Curve& curve, std::size_t index);
PlotLook look_of(const Band& band, std::size_t index);
PlotLook look_of(const Zone& zone, std::size_t index);  ///< opacity 0: it is left white
PlotLook look_of(const Mark& mark);
PlotLook look_of(const Lane& lane, std::size_t index);
/// Of the states of a lane that has other states than 0 and 1.
std::map<double, Tone> state_tones(const Lane& lane);

/// The curves' colours as --curve-1, --curve-2, ... of a page, by day and by night.
std::string palette_css();

}  // namespace drycut::renders
