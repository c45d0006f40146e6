#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/time.hpp"

namespace drycut::sim::record {

// What came of a run (outcome.hpp) names its members once, as archive(key, member); what is done with them is
// an archive: json.hpp, hdf5_rows.hpp, Python's. A member that is worked out, and not kept, is given as a
// value, which an archive that reads leaves alone. A time is written in seconds.

struct AnyArchive {
  template <typename Member>
  void operator()(const char*, Member&&) {}
};

template <typename T>
concept Visited = requires(AnyArchive& archive, T& value) {
  std::remove_const_t<T>::visit(archive, value);
};

template <typename T>
inline constexpr bool is_time = std::is_same_v<T, Time>;

template <typename T>
inline constexpr bool is_optional = false;
template <typename T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <typename T>
inline constexpr bool is_list = false;
template <typename T>
inline constexpr bool is_list<std::vector<T>> = true;

/// Values by name.
template <typename T>
inline constexpr bool is_map = false;
template <typename T>
inline constexpr bool is_map<std::map<std::string, T>> = true;

/// Points by the thousand, for pictures: Python has them, files do not.
template <typename T>
inline constexpr bool is_cloud = std::is_same_v<T, std::vector<std::pair<double, double>>>;

/// A list of visited values.
template <typename T>
inline constexpr bool is_table = false;
template <Visited T>
inline constexpr bool is_table<std::vector<T>> = true;

/// The word of an enumerator and back; `value` stays as it is where no enumerator has this word.
template <typename T>
std::string word_of(T value) {
  return std::string(words_of(value)[static_cast<std::size_t>(value)]);
}
template <typename T>
void take_word(const std::string& word, T& value) {
  const auto words = words_of(value);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i] == word) value = static_cast<T>(i);
}

}  // namespace drycut::sim::record
