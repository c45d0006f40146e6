#pragma once
#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace drycut::devices::plcopen {

/// Names of IEC 61131-3 are the same in any case: this is the one to compare.
inline std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace drycut::devices::plcopen
