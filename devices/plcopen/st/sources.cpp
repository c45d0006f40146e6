#include "devices/plcopen/st/sources.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace drycut::devices::plcopen::st {

SourceLines::SourceLines(std::span<const SourceFile> files) {
  for (const auto& [name, text] : files) {
    begins_.push_back(end_);
    names_.push_back(name);
    end_ += static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  }
}

SourceLines::At SourceLines::at(int line) const {
  const auto next = std::upper_bound(begins_.begin(), begins_.end(), line);
  if (next == begins_.begin()) return {0, line};
  return {static_cast<std::size_t>(next - begins_.begin()) - 1, line - *std::prev(next) + 1};
}

std::string SourceLines::told(int line, int seen_from) const {
  const auto [file, own] = at(line);
  if (names_.empty() || file == at(seen_from).file) return fmt::format("line {}", own);
  return fmt::format("line {} of {}", own, names_[file]);
}

}  // namespace drycut::devices::plcopen::st
