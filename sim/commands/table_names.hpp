#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "devices/problem.hpp"
#include "sim/commands/commands.hpp"

namespace drycut::sim {

/// The name that somebody asks for, in any case.
inline bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Says that there is no `kind` of that name, "device" or "plant", and which there are.
inline int unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
  const auto near = devices::nearest(name, names);
  std::string all;
  for (const auto& known : names) all += (all.empty() ? "" : ", ") + known;
  fmt::print(stderr, "drycut {}s: there is no {} type '{}'; {}\n", kind, kind, name,
             near.empty() ? "there are: " + all : fmt::format("did you mean {}?", near));
  return bad_input;
}

}  // namespace drycut::sim
