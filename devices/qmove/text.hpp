#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

// What the readers of .CNF and .MOD texts have in common: words of a line, reserved words.
namespace drycut::devices::qmove {

/// One blank-separated field of a line.
struct Word {
  std::string_view text;
  Place place;
};
using Words = std::vector<Word>;

/// The fields of a line up to its comment (`;`).
Words split_words(std::string_view line, int number);

/// The words of the language: no variable, device or label may have such a name.
const std::vector<std::string>& reserved_words();
bool is_reserved(std::string_view word);

}  // namespace drycut::devices::qmove
