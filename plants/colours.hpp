#pragma once
#include <array>

// What machines are painted in; what only one of them has stands with its parts.
namespace drycut::plants::colours {

using Colour = std::array<float, 3>;  ///< red, green, blue, 0..1

inline constexpr Colour steel = {0.74F, 0.76F, 0.78F};
inline constexpr Colour brass = {0.80F, 0.66F, 0.30F};
inline constexpr Colour dark = {0.12F, 0.12F, 0.13F};
inline constexpr Colour grey = {0.42F, 0.44F, 0.46F};
inline constexpr Colour white = {0.95F, 0.95F, 0.95F};
inline constexpr Colour red = {0.86F, 0.12F, 0.10F};
inline constexpr Colour green = {0.20F, 0.75F, 0.25F};
inline constexpr Colour bed = {0.16F, 0.30F, 0.42F};     ///< what stands: frames, beds, beams
inline constexpr Colour moving = {0.93F, 0.55F, 0.13F};  ///< what moves: carriages, rams

}  // namespace drycut::plants::colours
