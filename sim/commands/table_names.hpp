#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/problem.hpp"
#include "sim/commands/commands.hpp"

namespace drycut::sim {

/// Says that there is no `kind` of that name, "device" or "plant", and which there are.
inline int unknown(const std::string& kind, const std::string& name, const std::vector<std::string>& names) {
  const auto near = nearest(name, names);
  std::string all;
  for (const auto& known : names) all += (all.empty() ? "" : ", ") + known;
  fmt::print(stderr, "drycut {}s: there is no {} type '{}'; {}\n", kind, kind, name,
             near.empty() ? "there are: " + all : fmt::format("did you mean {}?", near));
  return bad_input;
}

}  // namespace drycut::sim
