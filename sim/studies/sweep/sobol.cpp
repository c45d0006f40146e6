// Sobol's sequence with the direction numbers of Joe and Kuo, "Constructing Sobol sequences with better
// two-dimensional projections", SIAM J. Sci. Comput. 30 (2008): new-joe-kuo-6.21201, its first rows.
#include <array>
#include <cstdint>

#include "sim/studies/sweep/axis.hpp"

namespace drycut::sim::studies {

namespace {

constexpr int sobol_bits = 32;
using Directions = std::array<std::uint32_t, sobol_bits>;

struct SobolRow {
  int degree;
  std::uint32_t polynomial;  // its inner coefficients
  std::array<std::uint32_t, 5> begin;
};
constexpr std::array<SobolRow, sobol_axes - 1> joe_kuo_rows = {{{1, 0, {1}},
                                                                {2, 1, {1, 3}},
                                                                {3, 1, {1, 3, 1}},
                                                                {3, 2, {1, 1, 1}},
                                                                {4, 1, {1, 1, 3, 3}},
                                                                {4, 4, {1, 3, 5, 13}},
                                                                {5, 2, {1, 1, 5, 5, 17}},
                                                                {5, 4, {1, 1, 5, 5, 5}},
                                                                {5, 7, {1, 1, 7, 11, 19}}}};

constexpr Directions directions_of(std::size_t axis) {
  Directions v{};
  if (axis == 0) {
    for (int i = 0; i < sobol_bits; ++i)
      v[static_cast<std::size_t>(i)] = 1U << static_cast<unsigned>(sobol_bits - 1 - i);
    return v;
  }
  const auto& [degree, polynomial, begin] = joe_kuo_rows[axis - 1];
  for (int i = 0; i < sobol_bits; ++i) {
    const auto at = [&v](int index) -> std::uint32_t& { return v[static_cast<std::size_t>(index)]; };
    if (i < degree) {
      at(i) = begin[static_cast<std::size_t>(i)] << static_cast<unsigned>(sobol_bits - 1 - i);
      continue;
    }
    at(i) = at(i - degree) ^ (at(i - degree) >> static_cast<unsigned>(degree));
    for (int k = 1; k < degree; ++k)
      if (((polynomial >> static_cast<unsigned>(degree - 1 - k)) & 1U) != 0) at(i) ^= at(i - k);
  }
  return v;
}

constexpr std::array<Directions, sobol_axes> all_directions = [] {
  std::array<Directions, sobol_axes> all{};
  for (std::size_t axis = 0; axis < sobol_axes; ++axis) all[axis] = directions_of(axis);
  return all;
}();

}  // namespace

double sobol_number(std::size_t axis, std::uint32_t number) {
  std::uint32_t value = 0;
  const auto gray = number ^ (number >> 1U);
  for (std::size_t i = 0; i < sobol_bits; ++i)
    if (((gray >> i) & 1U) != 0) value ^= all_directions[axis][i];
  constexpr double scale = 4294967296.0;
  return value / scale;
}

}  // namespace drycut::sim::studies
