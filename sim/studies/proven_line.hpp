#pragma once
#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

#include "sim/studies/fingerprint.hpp"

namespace drycut::sim::studies {

// Lines of files that studies go on from. Each ends with a checksum of the rest, so that damage costs the
// lines that it is in and no others.

/// A line with its checksum behind it: "a,b" becomes "a,b,0123456789abcdef".
inline std::string proven(std::string_view line) {
  Fingerprint sum;
  sum.add(line);
  return fmt::format("{},{:016x}", line, sum.value());
}

/// The line without its checksum, nothing where that is not its own.
inline std::optional<std::string_view> unharmed(std::string_view line) {
  const auto comma = line.rfind(',');
  if (comma == std::string_view::npos || proven(line.substr(0, comma)) != line) return {};
  return line.substr(0, comma);
}

}  // namespace drycut::sim::studies
