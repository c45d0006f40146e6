#include "sim/cam/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drycut::sim {

std::string Columns::text() const {
  std::vector<std::size_t> widths(words_.size(), 0);
  for (const auto& cells : lines_)
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  std::string text;
  for (const auto& cells : lines_) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i)
      line += words_[i] ? fmt::format("  {:<{}}", cells[i], widths[i])
                        : fmt::format("  {:>{}}", cells[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace drycut::sim
