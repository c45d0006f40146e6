#pragma once
#include <string_view>

namespace drycut::devices::camming4 {

/// What an error means (000 1.3; spec qem.md 8.9); "" for a code that does not exist.
std::string_view error_text(int code);
/// What a warning means (000 1.4; spec qem.md 8.10); "" for a code that does not exist.
std::string_view warning_text(int code);
/// Priority of a warning, 0 = highest (000 1.4).
int warning_priority(int code);

}  // namespace drycut::devices::camming4
