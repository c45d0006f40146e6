#pragma once
#include <array>
#include <initializer_list>
#include <string_view>

#include "devices/device.hpp"

// What every device's tables are written with; all of it is done while compiling.
namespace drycut::devices {

// constexpr where a consteval function hands its own parameters on: Clang 14 takes no consteval call there.

/// Number of the row called `name`; a name that is not in the table does not compile.
template <typename Rows>
constexpr int find_row(const Rows& rows, std::string_view name) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return static_cast<int>(i);
  throw "no such row";
}
template <typename Rows>
consteval int row_of(const Rows& rows, std::string_view name) {
  return find_row(rows, name);
}

/// The rows of `first`, then those of `then`.
template <typename Row, std::size_t N, std::size_t M>
consteval std::array<Row, N + M> joined(const std::array<Row, N>& first, const std::array<Row, M>& then) {
  std::array<Row, N + M> rows{};
  for (std::size_t i = 0; i < N; ++i) rows[i] = first[i];
  for (std::size_t i = 0; i < M; ++i) rows[N + i] = then[i];
  return rows;
}

/// The condition that these rows of `states` are 1, or 0 where the name begins with '!'.
template <typename States>
constexpr Condition condition_of(const States& states, std::initializer_list<std::string_view> names,
                                 std::string_view also = {}) {
  Condition condition{0, 0, also};
  for (std::string_view name : names) {
    const bool off = name.starts_with('!');
    const std::uint64_t bit = std::uint64_t{1} << find_row(states, off ? name.substr(1) : name);
    condition.mask |= bit;
    if (!off) condition.value |= bit;
  }
  return condition;
}

/// The effect that this row of `states` becomes 1, or 0 where the name begins with '!'. `quiet`: see Effect.
template <typename States>
constexpr Effect effect_of(const States& states, std::string_view name, bool quiet) {
  const bool off = name.starts_with('!');
  return {find_row(states, off ? name.substr(1) : name), !off, quiet};
}

}  // namespace drycut::devices
