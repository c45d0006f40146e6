#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace drycut::devices::qmove {

/// The words of the language: no variable, device or label may have such a name.
const std::vector<std::string>& reserved_words();
bool is_reserved(std::string_view word);

}  // namespace drycut::devices::qmove
