#pragma once
#include <string_view>

namespace drycut {

/// How bad an event is: nothing to do; to look at; the line does not do what it must; something broke, or may
/// have. An error or damage of a machine fails a run none of whose checks asks about it.
enum class Severity { note, warning, error, damage };

/// "note", "warning", "error", "damage".
constexpr std::string_view name_of(Severity severity) {
  constexpr std::string_view names[] = {"note", "warning", "error", "damage"};
  return names[static_cast<int>(severity)];
}

}  // namespace drycut
