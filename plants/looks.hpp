#pragma once
#include <array>
#include <string_view>

// What machines look like; what only one of them has stands with its parts.
namespace drycut::plants::looks {

/// A colour, red, green, blue of 0..1, and what is under it: see Part::material.
struct Look {
  std::array<float, 3> colour;
  std::string_view material = "paint";

  /// The same colour on another material.
  [[nodiscard]] constexpr Look on(std::string_view other) const { return {colour, other}; }
};

inline constexpr Look steel = {{0.74F, 0.76F, 0.78F}, "steel"};
inline constexpr Look brass = {{0.80F, 0.66F, 0.30F}, "steel"};
inline constexpr Look grey = {{0.42F, 0.44F, 0.46F}, "steel"};
inline constexpr Look dark = {{0.12F, 0.12F, 0.13F}};
inline constexpr Look white = {{0.95F, 0.95F, 0.95F}};
inline constexpr Look red = {{0.86F, 0.12F, 0.10F}};
inline constexpr Look green = {{0.20F, 0.75F, 0.25F}};
inline constexpr Look bearing = {{0.28F, 0.43F, 0.52F}};
inline constexpr Look bed = {{0.16F, 0.30F, 0.42F}};     ///< what stands: frames, beds, beams
inline constexpr Look moving = {{0.93F, 0.55F, 0.13F}};  ///< what moves: carriages, rams

}  // namespace drycut::plants::looks
